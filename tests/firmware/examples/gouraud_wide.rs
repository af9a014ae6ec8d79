//! The program of the scene `GouraudWide`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudWide);
