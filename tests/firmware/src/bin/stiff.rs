//! Solves the instances of stiff problems that `measure stiffness` has written to the file named in
//! `STIFF`.

#![cfg_attr(target_os = "none", no_std, no_main)]

include!(env!("STIFF"));

/// Starts the counter, says how this was compiled, and solves them.
fn solve() {
    firmware::counter::start();
    firmware::console::build();
    instances();
}

firmware::entry!(solve);
