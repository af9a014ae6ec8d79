//! The program of the scene `PhongLamp`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(PhongLamp);
