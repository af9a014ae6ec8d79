//! The program of the scene `FlatDirect`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(FlatDirect);
