//! The program of the scene `PointsDirect`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(PointsDirect);
