//! A progress bar on the standard error, if that is a terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `frames` frames, cleared when it is dropped.
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// Shows a bar for several frames, and a spinner for one.
    pub(super) fn over(frames: u32, doing: &'static str) -> Self {
        let bar =
            if frames > 1 { ProgressBar::new(frames.into()) } else { ProgressBar::new_spinner() };
        let template = if frames > 1 {
            "{msg} [{bar:30}] frame {pos} of {len}, {eta} left"
        } else {
            "{spinner} {msg}"
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_message(doing);
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar)
    }

    /// Counts a finished frame.
    pub(super) fn step(&self) {
        self.0.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
