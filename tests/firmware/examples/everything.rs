//! The program of the scene `Everything`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(Everything);
