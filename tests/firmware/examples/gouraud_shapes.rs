//! The program of the scene `GouraudShapes`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudShapes);
