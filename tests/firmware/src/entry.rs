//! How a program starts: the same on a microcontroller and on the host.

/// Makes a function without arguments the program, which ends when the function returns.
#[macro_export]
macro_rules! entry {
    ($run:path) => {
        #[cfg(not(target_os = "none"))]
        fn main() {
            $run();
        }

        #[cfg(target_os = "none")]
        #[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
        #[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
        fn main() -> ! {
            $run();
            $crate::console::exit()
        }

        #[cfg(target_os = "none")]
        #[panic_handler]
        fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
            $crate::console::panic(info)
        }
    };
}
