//! The program of the scene `VertexColors`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(VertexColors);
