//! The bundled models, generated from a few formulas: the same text on every machine.

mod gear;
mod rocket;
mod surface;
mod torus_knot;

/// The name and the text of each file.
pub(crate) fn files() -> Vec<(&'static str, String)> {
    [gear::files(), torus_knot::files(), rocket::files()].concat()
}
