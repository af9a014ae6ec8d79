//! Scenes whose flash and RAM are measured, from an empty program up to everything together.
//!
//! Each has its own program in `examples`, so that code it does not need is not linked. The
//! program keeps its buffers in a static, draws its frames on a [`Display`] that keeps only a
//! checksum, leaves that in [`CHECKSUM`] and ends. It formats nothing and unwraps nothing: on any
//! error it draws nothing, and the checksum stays 0.
//!
//! `measure` runs it in QEMU and reads the RAM when the core asks for a reset, or, on RISC-V, when
//! `ENDED` is set: the buffers, the checksum, and how far down the stack has reached.

mod display;
#[cfg(feature = "scenes")]
pub mod scenes;

use core::sync::atomic::{AtomicU32, Ordering};

pub use display::Display;

/// The checksum of the display at the end of the scene. 0 before, and if the scene failed.
#[used]
pub static CHECKSUM: AtomicU32 = AtomicU32::new(0);

/// Whether the program has ended, where `measure` cannot tell otherwise.
#[cfg(all(target_arch = "riscv32", target_os = "none"))]
#[used]
pub static ENDED: AtomicU32 = AtomicU32::new(0);

/// The buffers of a program, and what it draws with them.
pub trait Scene {
    /// The buffers.
    type Memory;

    /// The initial buffers. All their bits are 0, so that a static of them takes no flash.
    const MEMORY: Self::Memory;

    /// Draws all its frames. Returns `None` on any error.
    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()>;
}

/// Draws a scene and stores its checksum in [`CHECKSUM`].
pub fn run<S: Scene>(memory: &mut S::Memory) {
    let mut display = Display::default();
    if S::draw(memory, &mut display).is_some() {
        CHECKSUM.store(display.checksum(), Ordering::Relaxed);
    }
}

/// Makes one of the [`scenes`] a program.
#[macro_export]
macro_rules! scene {
    ($scene:ident) => {
        use $crate::sizes::scenes::$scene;

        $crate::program!($scene);
    };
}

/// Makes a [`Scene`] a program. On a microcontroller it has an entry, the buffers, an end and a
/// panic handler without a message; on the host it prints the checksum.
#[macro_export]
macro_rules! program {
    ($scene:ident) => {
        use $crate::sizes::{self, Scene};

        // The runtime lends the static.
        #[cfg(all(target_arch = "arm", target_os = "none"))]
        #[cortex_m_rt::entry]
        fn main() -> ! {
            static mut MEMORY: <$scene as Scene>::Memory = $scene::MEMORY;
            sizes::run::<$scene>(MEMORY);
            cortex_m::peripheral::SCB::sys_reset()
        }

        #[cfg(all(target_arch = "riscv32", target_os = "none"))]
        #[riscv_rt::entry]
        fn main() -> ! {
            use core::cell::RefCell;
            use critical_section::Mutex;
            static MEMORY: Mutex<RefCell<<$scene as Scene>::Memory>> =
                Mutex::new(RefCell::new($scene::MEMORY));
            critical_section::with(|cs| sizes::run::<$scene>(&mut MEMORY.borrow_ref_mut(cs)));
            sizes::ENDED.store(1, core::sync::atomic::Ordering::Relaxed);
            // Without semihosting this is a trap, in which the core stays.
            $crate::console::exit()
        }

        // Differs from the runtime's endless loops, with which the linker might merge it.
        #[cfg(target_os = "none")]
        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            loop {
                #[cfg(target_arch = "arm")]
                cortex_m::asm::udf();
                #[cfg(target_arch = "riscv32")]
                riscv::asm::wfi();
            }
        }

        #[cfg(not(target_os = "none"))]
        fn main() {
            let mut memory = Box::new($scene::MEMORY);
            sizes::run::<$scene>(&mut memory);
            let checksum = sizes::CHECKSUM.load(core::sync::atomic::Ordering::Relaxed);
            println!("{checksum:08x}");
        }
    };
}
