//! The program of the scene `FogPixels`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(FogPixels);
