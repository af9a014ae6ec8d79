//! The program of the scene `LinesHidden`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(LinesHidden);
