//! Scenes whose flash and RAM are measured, from an empty program up to everything at once.
//!
//! Each is a program of its own (`size_*`), so that what it does not need is not linked. It keeps
//! its buffers in a static, draws its frames on a [`Display`] that keeps nothing but a checksum,
//! leaves that in [`CHECKSUM`] and ends. It formats nothing and unwraps nothing: whatever goes
//! wrong, it draws nothing, and the checksum stays 0.
//!
//! Whoever runs it in QEMU reads the RAM when the core asks for a reset: the buffers, the checksum,
//! and how far the stack has come.

mod display;
mod frames;
mod scenes;

use core::sync::atomic::{AtomicU32, Ordering};

pub use display::Display;
pub use frames::Bands;
#[cfg(models)]
pub use scenes::Spot;
pub use scenes::{
    Deep, Empty, Everything, FlatBands, FlatDepth, FlatDirect, GouraudBinned, GouraudS4, GouraudS8,
    GouraudUnclipped, GouraudWide, Parallel, Sorted, Store, UnlitDirect,
};

/// What the display has seen when the scene ended; 0 before, and if it could not be drawn.
#[used]
pub static CHECKSUM: AtomicU32 = AtomicU32::new(0);

/// A program's buffers and what it draws with them.
pub trait Scene {
    /// The buffers.
    type Memory;

    /// The buffers in a static; all their bits are 0, so that they take no flash.
    const MEMORY: Self::Memory;

    /// Draws all its frames; nothing if that is impossible.
    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()>;
}

/// Draws a scene and leaves its checksum.
pub fn run<S: Scene>(memory: &mut S::Memory) {
    let mut display = Display::default();
    if S::draw(memory, &mut display).is_some() {
        CHECKSUM.store(display.checksum(), Ordering::Relaxed);
    }
}

/// The rest of a program that draws one scene: on a microcontroller the entry, the buffers, the end
/// and a panic handler without a message; on the host a program that prints the checksum.
#[macro_export]
macro_rules! scene {
    ($scene:ty) => {
        #[cfg(target_os = "none")]
        #[cortex_m_rt::entry]
        fn main() -> ! {
            static mut MEMORY: <$scene as $crate::sizes::Scene>::Memory =
                <$scene as $crate::sizes::Scene>::MEMORY;
            $crate::sizes::run::<$scene>(MEMORY);
            cortex_m::peripheral::SCB::sys_reset()
        }

        // Unlike any of the runtime's endless loops, which the linker might take for the same.
        #[cfg(target_os = "none")]
        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            loop {
                cortex_m::asm::udf();
            }
        }

        #[cfg(not(target_os = "none"))]
        fn main() {
            let mut memory = Box::new(<$scene as $crate::sizes::Scene>::MEMORY);
            $crate::sizes::run::<$scene>(&mut memory);
            let checksum = $crate::sizes::CHECKSUM.load(core::sync::atomic::Ordering::Relaxed);
            println!("{checksum:08x}");
        }
    };
}
