//! The program of the scene `GouraudLamp`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(GouraudLamp);
