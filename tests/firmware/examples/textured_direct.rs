//! The program of the scene `TexturedDirect`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(TexturedDirect);
