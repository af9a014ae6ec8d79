//! The program of the scene `ParticlesAdd`.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::scene!(ParticlesAdd);
