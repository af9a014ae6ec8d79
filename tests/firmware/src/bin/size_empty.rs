//! The program of the scene [`Empty`](firmware::sizes::Empty).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::Empty);
