//! The program of the scene `GouraudShaped`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudShaped);
