//! The `build.rs` of a firmware that draws a gear.
//!
//! The firmware's `Cargo.toml` names the converter without its command-line program:
//!
//! ```toml
//! [build-dependencies]
//! host-tools = { version = "0.1", default-features = false }
//! ```
//!
//! and a module of the firmware takes in the tables, which Cargo makes anew when the OBJ or its MTL
//! changes:
//!
//! ```ignore
//! include!(concat!(env!("OUT_DIR"), "/gear.rs")); // pub static GEAR: rasterizer::mesh::Mesh<'static>
//! ```

use std::{error::Error, path::Path};

use host_tools::model::{Contents, Options, convert_for_build};

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options {
        // A firmware that shades smoothly needs no face normals: 3 bytes of flash a triangle saved.
        contents: Contents { face_normals: false, ..Contents::default() },
        ..Options::default()
    };
    // A firmware's own models lie beside its build.rs: "models/gear.obj" is enough there.
    convert_for_build(Path::new(env!("CARGO_MANIFEST_DIR")).join("models/gear.obj"), &options)?;
    Ok(())
}
