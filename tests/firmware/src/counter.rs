//! Counts instructions in QEMU, where each takes a nanosecond with `-icount shift=0`.
//!
//! A count is in units of the core's timer: the system timer of Cortex-M boards ticks at 25 MHz (20
//! MHz on mps2-an505), every 40 (50) instructions; on RISC-V the register `mcycle` counts them one
//! by one. On the host nothing is counted.

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

/// Does nothing: the timer runs already.
#[cfg(not(all(target_os = "none", target_arch = "arm")))]
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

    /// Returns 0: the host does not count.
    #[cfg(not(target_os = "none"))]
    #[must_use]
    pub const fn now() -> Self {
        Self(0)
    }

    /// Returns the units since this moment. The system timer has 24 bits: it wraps after 671
    /// million instructions, `mcycle` after 4,295 million.
    #[cfg_attr(
        not(target_os = "none"),
        expect(clippy::missing_const_for_fn, reason = "on a core it reads the timer")
    )]
    #[must_use]
    pub fn elapsed(self) -> u32 {
        let now = Self::now();
        if cfg!(target_arch = "arm") {
            self.0.wrapping_sub(now.0) & 0xFF_FFFF
        } else {
            now.0.wrapping_sub(self.0)
        }
    }
}
