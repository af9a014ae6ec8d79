//! The program of the scene `TexturedTrilinear`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(TexturedTrilinear);
