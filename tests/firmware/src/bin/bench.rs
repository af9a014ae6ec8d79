//! Prints the cost of the frames of each bench scene. On the host it is in nanoseconds.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::main::<false>);
