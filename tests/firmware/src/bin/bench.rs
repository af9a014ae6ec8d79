//! Prints the cost of the frames of each bench scene. It is 0 on the host, where nothing counts
//! instructions.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::main::<false>);
