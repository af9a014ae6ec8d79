//! The program of the scene `LinesSmooth`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(LinesSmooth);
