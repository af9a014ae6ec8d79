//! The program of the scene `Deep`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(Deep);
