//! The program of the scene `Matcap`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(Matcap);
