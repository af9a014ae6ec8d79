//! The program of the scene [`FlatBands`](firmware::sizes::FlatBands).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::FlatBands);
