//! Generates the models in `host-tools/models`.
//!
//! `cargo run -p host-tools --example generate_models`

use std::path::Path;

use host_tools::model::{ModelError, write_atomically};

#[path = "../models/generator/mod.rs"]
mod generator;

fn main() -> Result<(), ModelError> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    for (name, contents) in generator::files() {
        write_atomically(&directory.join(name), &contents)?;
    }
    Ok(())
}
