//! The program of the scene `GouraudFloat`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudFloat);
