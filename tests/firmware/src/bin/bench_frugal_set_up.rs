//! Prints what such bands cost without their pixels; on the host, where nothing counts
//! instructions, zeros.

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

firmware::entry!(firmware::bench::frugal::<true>);
