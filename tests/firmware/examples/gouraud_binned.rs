//! The program of the scene `GouraudBinned`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudBinned);
