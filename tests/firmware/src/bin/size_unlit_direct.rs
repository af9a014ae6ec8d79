//! The program of the scene [`UnlitDirect`](firmware::sizes::UnlitDirect).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::scene!(firmware::sizes::UnlitDirect);
