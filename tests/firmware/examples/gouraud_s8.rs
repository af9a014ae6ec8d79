//! The program of the scene `GouraudS8`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudS8);
