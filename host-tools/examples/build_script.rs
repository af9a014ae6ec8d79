//! The `build.rs` of a firmware that draws a gear.
//!
//! The firmware's `Cargo.toml` names the converter without the comparison and the command line:
//!
//! ```toml
//! [build-dependencies]
//! host-tools = { version = "0.1", default-features = false }
//! ```
//!
//! A module of the firmware includes the tables. Cargo converts the model again when the OBJ, its
//! MTL or a picture changes:
//!
//! ```ignore
//! // pub static GEAR: rasterizer::mesh::Mesh<'static>
//! include!(concat!(env!("OUT_DIR"), "/gear.rs"));
//! ```

use std::{error::Error, path::Path};

use host_tools::model::{Contents, Options, convert_for_build};

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options {
        // Gouraud shading needs no face normals: this saves 3 bytes of flash per triangle.
        contents: Contents { face_normals: false, ..Contents::default() },
        ..Options::default()
    };
    // A firmware's own models lie beside its build.rs: there, "models/gear.obj" is enough.
    convert_for_build(Path::new(env!("CARGO_MANIFEST_DIR")).join("models/gear.obj"), &options)?;
    Ok(())
}
