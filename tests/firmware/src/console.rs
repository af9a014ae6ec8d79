//! The output of the firmware, and its end. Both use semihosting on a microcontroller.

use core::fmt::Arguments;

/// Prints a line.
#[cfg(target_os = "none")]
pub fn line(text: Arguments<'_>) {
    semihosting::println!("{text}");
}

/// Ends QEMU.
#[cfg(target_os = "none")]
pub fn exit() -> ! {
    semihosting::process::exit(0)
}

/// Reports a panic and ends QEMU with an error.
#[cfg(target_os = "none")]
pub fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    line(format_args!("{info}"));
    semihosting::process::exit(1)
}

#[cfg(not(target_os = "none"))]
extern crate std;

/// Prints a line.
#[cfg(not(target_os = "none"))]
pub fn line(text: Arguments<'_>) {
    std::println!("{text}");
}

/// Prints the `opt-level` that this was compiled with.
pub fn build() {
    line(format_args!("opt-level {}", env!("OPT_LEVEL")));
}
