//! The program of the scene `BlendedOver`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(BlendedOver);
