//! The program of the scene `Walk`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(Walk);
