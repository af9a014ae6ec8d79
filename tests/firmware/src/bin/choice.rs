//! Draws the frames of choices that `measure report` has written to the file named in `CHOICES`.

#![cfg_attr(target_os = "none", no_std, no_main)]

include!(env!("CHOICES"));

/// Starts the counter, says how this was compiled, and draws.
fn draw() {
    firmware::counter::start();
    firmware::console::build();
    choices();
}

firmware::entry!(draw);
