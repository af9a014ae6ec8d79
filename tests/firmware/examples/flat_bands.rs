//! The program of the scene `FlatBands`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(FlatBands);
