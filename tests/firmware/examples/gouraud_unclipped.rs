//! The program of the scene `GouraudUnclipped`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudUnclipped);
