//! The program of the scene [`GouraudS8`](firmware::sizes::GouraudS8).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::GouraudS8);
