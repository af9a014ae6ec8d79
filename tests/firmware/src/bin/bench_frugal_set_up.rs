//! Prints the cost of bands that keep vertices, bins or neither, without their pixels. On the host
//! it is in nanoseconds.

#![cfg_attr(target_os = "none", no_std, no_main)]

firmware::entry!(firmware::bench::frugal::<true>);
