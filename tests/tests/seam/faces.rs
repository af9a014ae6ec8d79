//! What a shader knows of a triangle and of its material.

use super::*;

/// A shader whose triangles have colours by their slope and size, and whose pixels follow the
/// triangle's plane.
#[derive(Clone, Copy)]
struct Slopes {
    /// Whether a triangle has one colour.
    is_flat: bool,
}

impl Shader for Slopes {
    type Color = Rgb888;
    type Varyings = ([u16; 1], i16);
    type Surface = ();
    type Face = Option<(Plane<[u32; 1]>, Plane<u32>)>;
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> ([u16; 1], i16) {
        let [x, y, _] = vertex.position();
        ([x as u16 ^ 0x8000], y)
    }

    fn face(
        &self,
        (): &(),
        _: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Rgb888, Self::Face> {
        let plane = gradients.field();
        if !self.is_flat {
            return Face::Shaded(Some(plane));
        }
        let ([x], y) = (plane.0.per_column, plane.1.per_column);
        let size = gradients.doubled_area() >> (2 * gradients.subpixel_bits());
        Face::Solid(Rgb888::new((x >> 18) as u8, (y >> 18) as u8, size as u8))
    }

    fn pixel(
        &self,
        (): &(),
        plane: &Self::Face,
        fragment: Fragment<([U16F16; 1], I16F16)>,
    ) -> Rgb888 {
        let ([x], y) = plane
            .map(|(one, other)| {
                (one.at(fragment.column, fragment.row), other.at(fragment.column, fragment.row))
            })
            .unwrap();
        let seen = (([U16F16::from_bits(x)]), I16F16::from_bits((y ^ 1 << 31) as i32));
        assert_eq!(fragment.varyings, seen);
        Rgb888::new((x >> 24) as u8, (y >> 24) as u8, 9)
    }
}

/// A face knows the plane that its pixels follow, the same in bands and in the whole frame, and
/// from vertices in both precisions.
#[test]
fn faces_know_their_gradients() {
    fn in_precision<S: Subpixel>() {
        let ball = ball();
        let mesh = ball.mesh();
        for eye in EYES {
            let camera = at(eye, DISPLAY);
            for is_flat in [true, false] {
                let object = Object::new(&mesh, Slopes { is_flat }).culled(CullNone);
                let seen = object.project_on_demand::<_, S, u16>(&camera, S::default()).unwrap();
                let whole = u16::frame(|frame| seen.draw(frame));
                bands_equal::<u16>(&whole, |band| seen.draw(band));
                let mut colors: Vec<_> =
                    whole.color.iter().map(|color| [color.r(), color.g(), color.b()]).collect();
                colors.sort_unstable();
                colors.dedup();
                assert!(colors.len() > 10, "{} colours from {eye}", colors.len());
            }
        }
    }
    in_precision::<S4>();
    in_precision::<S8>();
}

/// A triangle's place in the mesh's table, the varying at its corners, the doubled area in square
/// pixels, and the varying's change a column.
type Measured = (usize, [u16; 3], f64, f64);

/// A shader that notes what a face can know.
#[derive(Clone)]
struct Measuring<'l>(&'l RefCell<Vec<Measured>>);

impl Shader for Measuring<'_> {
    type Color = Rgb888;
    type Varyings = u16;
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> u16 {
        vertex.position()[0] as u16 ^ 0x8000
    }

    fn face(
        &self,
        (): &(),
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, u16>,
    ) -> Face<Rgb888, ()> {
        let unit = 2f64.powi(2 * gradients.subpixel_bits() as i32);
        let area = gradients.doubled_area() as f64 / unit;
        let slope = f64::from(gradients.field().per_column as i32) / 65_536.0;
        self.0.borrow_mut().push((face.index(), gradients.corners(), area, slope));
        Face::Solid(BACKGROUND)
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<U16F16>) -> Rgb888 {
        unreachable!("the face has a colour")
    }
}

/// The gradients of a face are those of its corners. Here no triangle is cut.
#[test]
fn gradients_are_those_of_the_corners() {
    fn in_precision<S: Subpixel>() {
        let (ball, log) = (ball(), RefCell::new(vec![]));
        let mesh = ball.mesh();
        let object = Object::new(&mesh, Measuring(&log)).culled(CullNone);
        let seen = object.project_on_demand::<_, S, NoDepth>(&at("3", DISPLAY), S::default());
        let seen = seen.unwrap();
        NoDepth::frame(|frame| seen.draw(frame));
        let log = log.take();
        let mut found = 0;
        let Ok(()) = seen.for_each_triangle(|index, corners| {
            let Some(&(_, values, area, slope)) = log.iter().find(|entry| entry.0 == index) else {
                return Ok(());
            };
            assert_eq!(values, corners.map(ScreenVertex::varyings));
            let [a, b, c] = corners.map(|corner| {
                corner.position().unwrap().map(|c| f64::from(c) / f64::from(1 << S::BITS))
            });
            let exact = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            assert_eq!(area, exact);
            // Slopes of thin triangles are cut to 32 bits.
            if area.abs() > 1.0 {
                let [va, vb, vc] = values.map(f64::from);
                let exact = ((vb - va) * (c[1] - a[1]) - (vc - va) * (b[1] - a[1])) / area;
                assert!((slope - exact).abs() < 0.01, "{slope} instead of {exact}");
                found += 1;
            }
            Ok::<(), Infallible>(())
        });
        assert!(found > 200, "{found}");
    }
    in_precision::<S4>();
    in_precision::<S8>();
}

/// A shader that notes which materials it gets, and for which triangles.
#[derive(Clone)]
struct Materials<'l>(&'l RefCell<Vec<(usize, Rgb888, usize)>>);

impl Shader for Materials<'_> {
    type Color = Rgb888;
    type Varyings = [u16; 0];
    type Surface = (usize, Rgb888);
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, material: &MeshMaterial<'_>) -> (usize, Rgb888) {
        (material.index(), material.rgb())
    }

    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    fn face(
        &self,
        &(material, color): &(usize, Rgb888),
        face: &MeshFace<'_>,
        _: &Gradients<'_, [u16; 0]>,
    ) -> Face<Rgb888, ()> {
        self.0.borrow_mut().push((material, color, face.index()));
        Face::Solid(color)
    }

    fn pixel(&self, _: &(usize, Rgb888), (): &(), _: Fragment<[U16F16; 0]>) -> Rgb888 {
        unreachable!("the face has a colour")
    }
}

/// A triangle gets the material whose run it is in, also behind an empty run.
#[test]
fn materials_are_those_of_their_runs() {
    let (ball, log) = (ball(), RefCell::new(vec![]));
    let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
    let object = Object::new(&mesh, Materials(&log)).culled(CullNone);
    let seen = object.project_on_demand::<_, S8, u16>(&at("3", DISPLAY), S8).unwrap();
    u16::frame(|frame| seen.draw(frame));
    let log = log.take();
    assert!(log.len() > 500, "{} triangles", log.len());
    let mut first = 0;
    for (index, material) in MATERIALS.iter().enumerate() {
        let run = first..first + material.triangle_count as usize;
        let [red, green, blue] = material.color;
        let want = (index, Rgb888::new(red, green, blue));
        let of_run: Vec<_> = log.iter().filter(|entry| run.contains(&entry.2)).collect();
        assert_eq!(of_run.is_empty(), material.triangle_count == 0);
        assert!(of_run.iter().all(|entry| (entry.0, entry.1) == want), "{of_run:?}");
        first = run.end;
    }
}
