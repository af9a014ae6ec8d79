//! Prints what bands cost that keep neither vertices nor bins, or one of the two; on the host,
//! where nothing counts instructions, zeros.

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::entry!(firmware::bench::frugal::<false>);
