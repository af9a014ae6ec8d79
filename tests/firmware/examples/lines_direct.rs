//! The program of the scene `LinesDirect`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(LinesDirect);
