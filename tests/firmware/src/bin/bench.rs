//! Prints how many instructions a frame of each bench scene takes; on the host, where nothing counts them, zeros.

#![cfg_attr(target_os = "none", no_std)]
#![cfg_attr(target_os = "none", no_main)]

use firmware::{
    bench::{self, PIXELS, VERTICES},
    memory::{Memory, Shared},
};

static MEMORY: Shared<PIXELS, VERTICES> = Memory::shared();

fn run(ticks: fn() -> u32) {
    critical_section::with(|token| bench::run(&mut MEMORY.borrow_ref_mut(token), ticks));
}

#[cfg(not(target_os = "none"))]
fn main() {
    run(|| 0);
}

#[cfg(target_os = "none")]
#[cortex_m_rt::entry]
fn main() -> ! {
    if let Some(mut core) = cortex_m::Peripherals::take() {
        core.SYST
            .set_clock_source(cortex_m::peripheral::syst::SystClkSource::Core);
        core.SYST.set_reload(0xFF_FFFF);
        core.SYST.clear_current();
        core.SYST.enable_counter();
    }
    run(cortex_m::peripheral::SYST::get_current);
    firmware::console::exit()
}

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    firmware::console::panic(info)
}
