//! The program of the scene `TexturedGouraud`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(TexturedGouraud);
