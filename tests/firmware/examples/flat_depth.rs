//! The program of the scene `FlatDepth`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(FlatDepth);
