//! What the firmware says, and how it ends: by semihosting on a microcontroller, as any program on the host.

use core::fmt::Arguments;

/// Prints a line.
#[cfg(target_os = "none")]
pub fn line(text: Arguments<'_>) {
    cortex_m_semihosting::hprintln!("{}", text);
}

/// Ends QEMU.
#[cfg(target_os = "none")]
pub fn exit() -> ! {
    loop {
        cortex_m_semihosting::debug::exit(cortex_m_semihosting::debug::EXIT_SUCCESS);
    }
}

/// Reports a panic and ends QEMU with an error.
#[cfg(target_os = "none")]
pub fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    line(format_args!("{info}"));
    loop {
        cortex_m_semihosting::debug::exit(cortex_m_semihosting::debug::EXIT_FAILURE);
    }
}

#[cfg(not(target_os = "none"))]
extern crate std;

/// Prints a line.
#[cfg(not(target_os = "none"))]
pub fn line(text: Arguments<'_>) {
    std::println!("{text}");
}
