//! Prints the cost of the frames of the walk through a small world. On the host it is in
//! nanoseconds.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::walk::main);
