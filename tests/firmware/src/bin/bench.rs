//! Prints what the frames of each bench scene cost; on the host, where nothing counts instructions,
//! zeros.

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::entry!(firmware::bench::main::<false>);
