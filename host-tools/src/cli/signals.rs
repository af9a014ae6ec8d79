//! Signals that end the program wait while a file gets its name.

use std::sync::{
    Arc, LazyLock,
    atomic::{AtomicBool, Ordering},
};

/// Whether signals are passed on when they come, and those that have come.
struct Signals {
    pass: Arc<AtomicBool>,
    came: Vec<(i32, Arc<AtomicBool>)>,
}

static SIGNALS: LazyLock<Signals> = LazyLock::new(|| {
    let pass = Arc::new(AtomicBool::new(true));
    let came = register(&pass);
    Signals { pass, came }
});

#[cfg(unix)]
fn register(pass: &Arc<AtomicBool>) -> Vec<(i32, Arc<AtomicBool>)> {
    use signal_hook::{
        consts::{SIGHUP, SIGINT, SIGTERM},
        flag,
    };
    let register = |signal| {
        let came = Arc::new(AtomicBool::new(false));
        flag::register_conditional_default(signal, Arc::clone(pass)).ok()?;
        flag::register(signal, Arc::clone(&came)).ok()?;
        Some((signal, came))
    };
    [SIGHUP, SIGINT, SIGTERM].into_iter().filter_map(register).collect()
}

/// Elsewhere signals end the program when they come.
#[cfg(not(unix))]
fn register(_: &Arc<AtomicBool>) -> Vec<(i32, Arc<AtomicBool>)> {
    Vec::new()
}

/// Lets signals wait.
pub(super) fn hold() {
    SIGNALS.pass.store(false, Ordering::SeqCst);
}

/// Ends the program by a signal that waits, and lets others do so again.
pub(super) fn pass_on() {
    SIGNALS.pass.store(true, Ordering::SeqCst);
    for (_signal, came) in &SIGNALS.came {
        if came.swap(false, Ordering::SeqCst) {
            #[cfg(unix)]
            let _ = signal_hook::low_level::emulate_default_handler(*_signal);
        }
    }
}
