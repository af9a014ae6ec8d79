//! The program of the scene `Parallel`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(Parallel);
