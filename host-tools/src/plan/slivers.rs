//! Which triangles of a view are slivers: so thin that their gradients are divided exactly, and not
//! by the reciprocal of their area. With 8 bits of sub-pixels those of over 128 pixels are, too.

use std::{cell::Cell, convert::Infallible};

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{
        Field, Interpolate, InverseW, NoDepth, Piece, QuickGradients, TriangleSetup, Varyings,
    },
    geometry::ScreenVertex,
    mesh::{MeshFace, MeshMaterial, MeshVertex},
    numbers::Subpixel,
    output::Target,
    raster::{Fragment, FragmentOf, Gradients, Layout, Primitive, Window},
    scene::Object,
    shade::{Face, Outcome, Shader},
};

use super::{
    band_rows,
    seen::{Eye, add_bands},
    views::Placed,
};
use crate::check::ViewError;

/// The slivers of a view for which planes are computed: the centre of a pixel lies between their
/// corners, covered or not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Slivers {
    /// For each of [`band_rows`], how often bands meet them: first their number, in one band. Empty
    /// if there are none.
    pub met: Vec<u64>,
    /// Their rows without a covered pixel.
    pub empty_rows: u64,
}

/// A varying without a value, which counts the planes that are divided exactly.
#[derive(Clone, Copy, Debug)]
struct Probe<'c>(Option<&'c Cell<u64>>);

/// A plane without a value.
#[derive(Clone, Copy, Debug)]
struct Nothing;

impl Varyings for Probe<'_> {
    type OnScreen = Self;

    fn lerp(self, _: Self, _: u32) -> Self {
        self
    }

    fn on_screen(self, _: InverseW) -> Self {
        self
    }
}

impl Field for Nothing {
    fn over_addresses(self, _: [i32; 2], _: i32) -> Self {
        self
    }
}

impl Interpolate for Probe<'_> {
    const ZERO: Self = Self(None);

    type Field = Nothing;
    type Walk = [u32; 0];
    type Rest = std::iter::Empty<Piece<[u32; 0]>>;
    type Sample = ();

    fn plane<S: Subpixel>(
        _: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        [Self(count), ..]: [Self; 3],
    ) -> Nothing {
        if let (Some(count), None) = (count, quick) {
            count.set(count.get() + 1);
        }
        Nothing
    }

    fn whole(field: &Nothing, at: [i32; 2], pixels: usize) -> Option<Piece<[u32; 0]>> {
        Some(Self::walk(field, at, pixels).0)
    }

    fn walk(_: &Nothing, _: [i32; 2], pixels: usize) -> (Piece<[u32; 0]>, Self::Rest) {
        (Piece { first: [], step: [], pixels }, std::iter::empty())
    }

    fn sample(_: [u32; 0]) {}
}

/// The shader of the probe.
#[derive(Clone, Copy, Debug)]
struct Probing<'c>(&'c Cell<u64>);

impl<'c> Shader for Probing<'c> {
    type Color = ();
    type Varyings = Probe<'c>;
    type Surface = ();
    type Face = ();
    type Outcome = ();

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, _: &MeshVertex<'_>) -> Probe<'c> {
        Probe(Some(self.0))
    }

    fn face(&self, (): &(), _: &MeshFace<'_>, _: &Gradients<'_, Probe<'c>>) -> Face<(), ()> {
        Face::Shaded(())
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<()>) {}
}

/// A target that counts slivers.
struct Counter<'c> {
    size: [u32; 2],
    bands: Vec<u32>,
    planes: &'c Cell<u64>,
    slivers: Slivers,
}

impl Counter<'_> {
    /// The rows of a triangle in a window, if it is a sliver that may cover a pixel there.
    fn rows<Q: Primitive>(&self, primitive: &Q, window: &Window) -> Option<u64> {
        let (before, mut rows) = (self.planes.get(), 0);
        let Ok(()) = primitive.for_each_span(window, Layout { pitch: 0, origin: 0 }, |_| {
            rows += 1;
            Ok::<(), Infallible>(())
        });
        (self.planes.get() > before).then_some(rows)
    }
}

impl Target for Counter<'_> {
    type Color = ();
    type Depth = NoDepth;
    type Error = Infallible;

    fn window(&self) -> Window {
        Window::new(&Rectangle::new(Point::zero(), Size::new(self.size[0], self.size[1])))
    }

    fn shade<Q: Primitive<Depth = NoDepth>, O: Outcome<()>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        _: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        if let Some(covered) = self.rows(primitive, window) {
            let mut rows = 0..self.size[1] as i32;
            let mut is_met = |&row: &i32| {
                let row = Rectangle::new(Point::new(0, row), Size::new(self.size[0], 1));
                self.rows(primitive, &Window::new(&row)).is_some()
            };
            let first = rows.find(&mut is_met).unwrap_or(0);
            let last = rows.rfind(&mut is_met).unwrap_or(first);
            self.slivers.empty_rows += (last - first + 1) as u64 - covered;
            add_bands(&mut self.slivers.met, &self.bands, [first, last]);
        }
        Ok(())
    }
}

impl Eye<'_> {
    /// The slivers of a view.
    ///
    /// # Errors
    ///
    /// Returns an error if the core refuses the view.
    pub(super) fn slivers<S: Subpixel>(&self, view: &Placed) -> Result<Slivers, ViewError> {
        let planes = Cell::new(0);
        let mut vertices = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; self.mesh.vertex_count()];
        let object = Object::new(self.mesh, Probing(&planes)).posed(view.pose());
        let seen = object.project(&self.camera(view)?, &mut vertices)?;
        let (size, bands) = (self.size, band_rows(self.size[1]));
        let mut counter = Counter { size, bands, planes: &planes, slivers: Slivers::default() };
        let Ok(()) = seen.draw(&mut counter);
        Ok(counter.slivers)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use rasterizer::{
        camera::{Distance, Perspective},
        numbers::{Rotation, S4, S8},
    };

    use super::*;
    use crate::{
        check::angle,
        model::{Model, Options},
    };

    /// A right triangle of a width and a height in units of some 100 pixels, above one of half a
    /// unit.
    fn slivers<S: Subpixel>(width: f64, height: f64) -> Slivers {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("pair.obj");
        let right = width / 2.0;
        let pair = format!(
            "v -{right} 0 0\nv {right} 0 0\nv {right} {height} 0\n\
             v 0 -1 0\nv 0.5 -1 0\nv 0.5 -0.5 0\nf 1 2 3\nf 4 5 6\n"
        );
        fs::write(&path, pair).unwrap();
        let model = Model::load(&path, &Options::default()).unwrap();
        let mesh = model.mesh();
        let lens = Perspective::new(angle(60.0), Distance::lit("0.5"), Distance::lit("5"));
        let eye = Eye { mesh: &mesh, lens: lens.unwrap(), size: [320, 240] };
        let view = Placed { rotation: Rotation::about_y(angle(10.0)), distance: 2.0 };
        eye.slivers::<S>(&view).unwrap()
    }

    #[test]
    fn thin_triangles_are_slivers() {
        assert_eq!([slivers::<S4>(1.0, 0.5), slivers::<S8>(1.0, 0.5)], [const { NONE }; 2]);
        // Half a pixel high, on some ten rows: in bands of four rows and more.
        for thin in [slivers::<S4>(1.0, 0.005), slivers::<S8>(1.0, 0.005)] {
            assert_eq!(thin.met[0], 1);
            assert!(thin.met.iter().all(|met| (1..=4).contains(met)), "{thin:?}");
            assert!(thin.empty_rows <= 1, "{thin:?}");
        }
        // Numerators of wide triangles take more than 32 bits.
        let wide = [slivers::<S4>(2.0, 0.5), slivers::<S8>(2.0, 0.5)];
        assert_eq!(wide.map(|slivers| slivers.met.first().copied()), [None, Some(1)]);
    }

    const NONE: Slivers = Slivers { met: Vec::new(), empty_rows: 0 };
}
