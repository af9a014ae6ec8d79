//! The program of the scene [`Everything`](firmware::sizes::Everything).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::Everything);
