//! The program of the scene `Spot`, or of `Empty` without the model.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(models)]
firmware::scene!(Spot);
#[cfg(not(models))]
firmware::scene!(Empty);
