//! The program of the scene `GlossyGouraud`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GlossyGouraud);
