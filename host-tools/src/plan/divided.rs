//! How often texture coordinates are divided by 1 / w in a view: by the core.

use std::convert::Infallible;

use rasterizer::{
    attribute::{Adaptive, Interpolate as _, NoDepth, PerspectiveCorrect},
    geometry::ScreenVertex,
    mesh::{MeshFace, MeshMaterial, MeshVertex},
    numbers::{S4, S8, Subpixel},
    output::Target,
    raster::{Fragment, FragmentOf, Gradients, Layout, Primitive, Window},
    scene::Object,
    shade::{Face, OnScreen, Outcome, Sample, Shader},
};

use super::{seen::Eye, views::Placed};
use crate::check::{Subpixel as Precision, ViewError};

/// What is divided in a view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Divided {
    /// Triangles that straight lines between their corners are not right for.
    pub triangles: u64,
    /// Their rows.
    pub rows: u64,
    /// The pieces of these, between two divisions each.
    pub pieces: u64,
}

/// Coordinates are counted in eighths of a texel, so that 16 bits hold 4,096 texels: a texture of
/// 256 texels that repeats 16 times. What is beyond is held at the end.
const UNITS: f64 = 8.0;

/// A tolerance of half a texel, as renderers have it: four units, in sixteenths.
type HalfTexel = Adaptive<{ 4 * 16 }>;

/// A shader of texture coordinates, without a texture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coordinates {
    /// The texture's width and height, in texels.
    pub(super) size: [usize; 2],
}

impl Shader for Coordinates {
    type Color = ();
    type Varyings = PerspectiveCorrect<[i16; 2], HalfTexel>;
    type Surface = ();
    type Face = ();
    type Outcome = ();

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        let turns = vertex.texture_coordinates().map(|c| f64::from(c) / f64::from(1 << 24));
        // A conversion to an integer ends at its largest and its least number.
        let units = [0, 1].map(|i| (turns[i] * self.size[i] as f64 * UNITS).round() as i16);
        PerspectiveCorrect::new(units)
    }

    fn face(&self, (): &(), _: &MeshFace<'_>, _: &Gradients<'_, OnScreen<Self>>) -> Face<(), ()> {
        Face::Shaded(())
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<Sample<Self>>) {}
}

/// A target that counts what is divided.
struct Counter {
    window: Window,
    divided: Divided,
}

impl Target for Counter {
    type Color = ();
    type Depth = NoDepth;
    type Error = Infallible;

    fn window(&self) -> Window {
        self.window
    }

    fn shade<Q: Primitive<Depth = NoDepth>, O: Outcome<()>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        _: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        let (mut rows, mut pieces) = (0, 0);
        primitive.for_each_span(window, Layout { pitch: 0, origin: 0 }, |span| {
            let (at, pixels) = ([span.start as i32, span.row], span.end - span.start);
            if Q::Varyings::whole(span.varyings, at, pixels).is_none() {
                rows += 1;
                let mut left = pixels;
                Q::Varyings::for_each_piece(span.varyings, at, pixels, |piece| {
                    pieces += 1;
                    left -= piece.pixels;
                    left
                });
            }
            Ok::<(), Infallible>(())
        })?;
        let divided = &mut self.divided;
        divided.triangles += u64::from(rows > 0);
        divided.rows += rows;
        divided.pieces += pieces;
        Ok(())
    }
}

impl Eye<'_> {
    /// What is divided in a view.
    ///
    /// # Errors
    ///
    /// Returns an error if the core refuses the view.
    pub(super) fn divide(
        &self,
        precision: Precision,
        view: &Placed,
        coordinates: Coordinates,
    ) -> Result<Divided, ViewError> {
        match precision {
            Precision::S4 => self.divide_in::<S4>(view, coordinates),
            Precision::S8 => self.divide_in::<S8>(view, coordinates),
        }
    }

    fn divide_in<S: Subpixel>(
        &self,
        view: &Placed,
        coordinates: Coordinates,
    ) -> Result<Divided, ViewError> {
        let mut vertices = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; self.mesh.vertex_count()];
        let object = Object::new(self.mesh, coordinates).posed(view.pose());
        let seen = object.project(&self.camera(view)?, &mut vertices)?;
        let mut counter =
            Counter { window: Window::new(&self.area()), divided: Divided::default() };
        let Ok(()) = seen.draw(&mut counter);
        Ok(counter.divided)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use rasterizer::{
        camera::{Distance, Perspective},
        numbers::Rotation,
    };

    use super::*;
    use crate::{
        check::angle,
        model::{Contents, Model, Options},
    };

    /// What is divided of a turned square, with a texture of some texels a side.
    fn divided(degrees: f64, texels: usize) -> Divided {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("sheet.obj");
        let sheet = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                     f 1/1 2/2 3/3 4/4\n";
        fs::write(&path, sheet).unwrap();
        let contents = Contents { texture_coordinates: true, ..Contents::default() };
        let options = Options { contents, ..Options::default() };
        let model = Model::load(&path, &options).unwrap();
        let mesh = model.mesh();
        let lens = Perspective::new(angle(60.0), Distance::lit("0.5"), Distance::lit("5"));
        let eye = Eye { mesh: &mesh, lens: lens.unwrap(), size: [320, 240] };
        let view = Placed { rotation: Rotation::about_y(angle(degrees)), distance: 2.0 };
        eye.divide(Precision::S4, &view, Coordinates { size: [texels; 2] }).unwrap()
    }

    #[test]
    fn what_has_one_distance_is_not_divided() {
        assert_eq!(divided(0.0, 256), Divided::default());
        // Nor is what straight lines show within half a texel.
        assert_eq!(divided(50.0, 2), Divided::default());
    }

    #[test]
    fn divisions_follow_the_law_of_the_error() {
        let [few, many] = [divided(50.0, 64), divided(50.0, 1_024)];
        assert_eq!((few.triangles, few.rows), (2, many.rows));
        assert!(few.rows > 200 && few.pieces > few.rows, "{few:?}");
        // The error of a step grows with its square and with the texels: 16 times as many halve it
        // twice. Steps are whole pixels, rounded down, and the last one of a row is shorter.
        let ratio = many.pieces as f64 / few.pieces as f64;
        assert!((3.0..5.5).contains(&ratio), "{few:?}, {many:?}");
    }
}
