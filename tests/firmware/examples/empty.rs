//! The program of the scene `Empty`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(Empty);
