//! The program of the scene [`GouraudBinned`](firmware::sizes::GouraudBinned).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::GouraudBinned);
