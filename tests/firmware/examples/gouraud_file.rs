//! The program of the scene `GouraudFile`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudFile);
