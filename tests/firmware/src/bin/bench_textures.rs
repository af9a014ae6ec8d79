//! Prints the cost of the frames of the bench scenes with textures. It is 0 on the host, where
//! nothing counts instructions.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::textures::main::<false>);
