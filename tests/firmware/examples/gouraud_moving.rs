//! The program of the scene `GouraudMoving`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudMoving);
