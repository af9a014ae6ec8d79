//! The program of the scene `BlendedSorted`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(BlendedSorted);
