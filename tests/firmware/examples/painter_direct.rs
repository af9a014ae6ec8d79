//! The program of the scene `PainterDirect`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(PainterDirect);
