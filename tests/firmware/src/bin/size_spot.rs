//! The program of the scene `Spot`; without the model, of [`Empty`](firmware::sizes::Empty).

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

#[cfg(models)]
firmware::scene!(firmware::sizes::Spot);
#[cfg(not(models))]
firmware::scene!(firmware::sizes::Empty);
