//! The program of the scene `TexturedBilinear`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(TexturedBilinear);
