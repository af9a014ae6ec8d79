//! The program of the scene `UnlitDirect`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(UnlitDirect);
