//! The program of the scene `DitheredDirect`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(DitheredDirect);
