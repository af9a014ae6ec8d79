//! The program of the scene `GouraudMorph`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudMorph);
