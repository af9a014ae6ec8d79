//! The program of the scene [`FlatDepth`](firmware::sizes::FlatDepth).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::FlatDepth);
