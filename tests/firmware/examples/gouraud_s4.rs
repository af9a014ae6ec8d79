//! The program of the scene `GouraudS4`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudS4);
