//! The program of the scene [`Deep`](firmware::sizes::Deep).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::Deep);
