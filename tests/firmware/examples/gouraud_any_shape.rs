//! The program of the scene `GouraudAnyShape`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudAnyShape);
