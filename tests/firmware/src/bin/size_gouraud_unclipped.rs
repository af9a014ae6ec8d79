//! The program of the scene [`GouraudUnclipped`](firmware::sizes::GouraudUnclipped).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::GouraudUnclipped);
