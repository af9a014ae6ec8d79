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

/// Nanoseconds since the first call, modulo 2^32.
#[cfg(not(target_os = "none"))]
pub fn nanoseconds() -> u32 {
    static FIRST: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    FIRST.get_or_init(std::time::Instant::now).elapsed().as_nanos() as u32
}

/// Writes a picture, if the environment names a folder for pictures in `PICTURES`: red, green and
/// blue of each pixel, row by row.
///
/// # Panics
///
/// Panics if it cannot be written.
#[cfg(not(target_os = "none"))]
pub fn picture(name: &str, frame: u32, channels: impl Iterator<Item = u8>) {
    if let Some(folder) = std::env::var_os("PICTURES") {
        let path = std::path::Path::new(&folder).join(std::format!("{name}-{frame}.rgb"));
        let channels: std::vec::Vec<u8> = channels.collect();
        std::fs::write(&path, channels)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}

/// Does nothing: a microcontroller has no files.
#[cfg(target_os = "none")]
pub fn picture(_: &str, _: u32, _: impl Iterator<Item = u8>) {}

/// Whether the environment asks for the scene in its shifted place, by `SHIFTED`.
#[cfg(not(target_os = "none"))]
pub fn is_shifted() -> bool {
    std::env::var_os("SHIFTED").is_some()
}

/// No: a microcontroller has no environment.
#[cfg(target_os = "none")]
pub const fn is_shifted() -> bool {
    false
}

/// Prints the `opt-level` that this was compiled with.
pub fn build() {
    line(format_args!("opt-level {}", env!("OPT_LEVEL")));
}
