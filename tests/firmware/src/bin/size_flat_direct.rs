//! The program of the scene [`FlatDirect`](firmware::sizes::FlatDirect).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::FlatDirect);
