//! Prints the cost of bands that keep vertices, bins or neither. It is 0 on the host, where nothing
//! counts instructions.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::frugal::<false>);
