//! The prelude goes together with the one of embedded-graphics: no name is in both.

#[expect(unused_imports, reason = "nothing but names that differ")]
mod both {
    pub(crate) use embedded_graphics::prelude::*;
    pub(crate) use rasterizer::prelude::*;
}

/// Names each item, which does not compile if both preludes have it, and lists the names.
macro_rules! named {
    ($($name:ident),* $(,)?) => {
        #[expect(unused_imports, reason = "a name that is in both preludes is an error here")]
        use both::{$($name),*};
        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

named![
    Bands,
    Camera,
    ClipAll,
    ClipNone,
    CullBack,
    CullFront,
    CullNone,
    Direct,
    Distance,
    Flat,
    FloatDepth,
    Frame,
    Gouraud,
    Level,
    Light,
    Mesh,
    Needs,
    NoDepth,
    Object,
    ObjectView,
    Orthographic,
    Perspective,
    Pose,
    Rgb565Be,
    Rotation,
    S4,
    S8,
    Scalar,
    ScreenVertex,
    Shader,
    Textured,
    TexturedFlat,
    TexturedGouraud,
    Turn,
    Unlit,
    Vec3,
];

#[test]
fn every_name_of_the_prelude_is_tried() {
    let source = include_str!("../src/prelude.rs");
    let (_, list) = source.split_once("pub use").expect("the prelude is one list of names");
    let words = list.split(|c: char| !c.is_alphanumeric());
    let mut names: Vec<&str> = words.filter(|word| word.starts_with(char::is_uppercase)).collect();
    names.sort_unstable();
    assert_eq!(names, NAMES);
}
