//! The bundled models, generated from a few formulas: the same text and the same pictures on every
//! machine.

mod gear;
mod rocket;
mod surface;
mod torus_knot;
mod wood;
mod wooden_crate;

/// The name and the contents of each file.
pub(crate) fn files() -> Vec<(&'static str, Vec<u8>)> {
    let texts = [gear::files(), torus_knot::files(), rocket::files()].concat();
    let texts = texts.into_iter().map(|(name, text)| (name, text.into_bytes()));
    texts.chain(wooden_crate::files()).collect()
}
