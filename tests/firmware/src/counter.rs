//! Measures the stages of a frame, on a board and in QEMU.
//!
//! On a board a timer counts cycles: the system timer of a Cortex-M, the register `mcycle` of a
//! RISC-V core. QEMU knows no cycles, so its timers tell nothing there. Instead, a plugin counts
//! instructions between [marks](mark): `tests/measure/plugin`. On the host it counts nanoseconds.

use core::{
    hint::black_box,
    sync::atomic::{AtomicU32, Ordering, compiler_fence},
};

#[cfg(not(target_os = "none"))]
use crate::console;

/// A part of a frame that is measured on its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Setting depth to the far end.
    Clear,
    /// Transforming, lighting and projecting vertices.
    Vertices,
    /// Everything behind that.
    Draw,
}

/// A word for each stage, and one for [`report`]. The plugin watches who writes to them; `measure`
/// finds them in a program by their name.
static MARKS: [AtomicU32; 4] = [const { AtomicU32::new(0) }; 4];

/// Tells the plugin that a stage begins, and that it ends.
#[inline(always)]
pub fn mark(stage: Stage) {
    set(stage as usize);
}

/// Tells the plugin that the stages measured since the last report belong to one line of output.
pub fn report() {
    set(MARKS.len() - 1);
}

#[inline(always)]
fn set(mark: usize) {
    // The compiler would drop stores that nothing reads, and might move others past them.
    compiler_fence(Ordering::SeqCst);
    black_box(&MARKS)[mark].store(0, Ordering::Relaxed);
    compiler_fence(Ordering::SeqCst);
}

/// Starts the timer.
#[cfg(all(target_os = "none", target_arch = "arm"))]
pub fn start() {
    if let Some(mut core) = cortex_m::Peripherals::take() {
        core.SYST.set_clock_source(cortex_m::peripheral::syst::SystClkSource::Core);
        core.SYST.set_reload(0xFF_FFFF);
        core.SYST.clear_current();
        core.SYST.enable_counter();
    }
}

/// Checks that the timer runs, as it does on most cores from the start.
///
/// # Panics
///
/// Panics if it does not. Starting it takes `unsafe` code: see `tests/measure/BOARDS.md`.
#[cfg(all(target_os = "none", target_arch = "riscv32"))]
pub fn start() {
    let start = Moment::now();
    assert!(start.elapsed() > 0, "mcycle does not count: mcountinhibit stops it");
}

/// Does nothing: the host's clock runs.
#[cfg(not(target_os = "none"))]
pub const fn start() {}

/// A reading of the timer.
#[derive(Clone, Copy, Debug)]
pub struct Moment(u32);

impl Moment {
    /// Reads the timer.
    #[cfg(all(target_os = "none", target_arch = "arm"))]
    #[must_use]
    pub fn now() -> Self {
        Self(cortex_m::peripheral::SYST::get_current())
    }

    /// Reads the timer.
    #[cfg(all(target_os = "none", target_arch = "riscv32"))]
    #[must_use]
    pub fn now() -> Self {
        Self(riscv::register::mcycle::read() as u32)
    }

    /// Reads the clock.
    #[cfg(not(target_os = "none"))]
    #[must_use]
    pub fn now() -> Self {
        Self(console::nanoseconds())
    }

    /// Returns the cycles since this moment, nanoseconds on the host. The system timer has 24 bits:
    /// it wraps after 16.8 million cycles. Of `mcycle` and of the nanoseconds 32 bits are used.
    #[must_use]
    pub fn elapsed(self) -> u32 {
        let now = Self::now();
        if cfg!(all(target_arch = "arm", target_os = "none")) {
            self.0.wrapping_sub(now.0) & 0xFF_FFFF
        } else {
            now.0.wrapping_sub(self.0)
        }
    }
}
