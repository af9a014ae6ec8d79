//! The program of the scene [`GouraudS4`](firmware::sizes::GouraudS4).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::GouraudS4);
