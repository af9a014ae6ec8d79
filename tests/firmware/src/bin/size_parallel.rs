//! The program of the scene [`Parallel`](firmware::sizes::Parallel).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::Parallel);
