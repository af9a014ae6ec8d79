//! The program of the scene `FogVertices`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(FogVertices);
