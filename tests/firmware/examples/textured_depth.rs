//! The program of the scene `TexturedDepth`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(TexturedDepth);
