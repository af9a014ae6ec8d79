//! The program of the scene `DitheredPacked`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(DitheredPacked);
