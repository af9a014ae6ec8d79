//! The program of the scene `Phong`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(Phong);
