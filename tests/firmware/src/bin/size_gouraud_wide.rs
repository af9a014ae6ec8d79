//! The program of the scene [`GouraudWide`](firmware::sizes::GouraudWide).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::GouraudWide);
