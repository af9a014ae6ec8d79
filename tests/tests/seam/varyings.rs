//! Varyings of several kinds: what pixels see lies on the plane through the corners.

use super::*;

/// Fragments of pixels, with the places of their triangles in the mesh's table.
pub(super) type Logged<W> = Vec<(usize, Fragment<Sampled<W>>)>;

/// A shader that notes what its pixels see.
#[derive(Clone)]
struct Noting<'l, W: Varyings> {
    vertex: fn([i16; 3]) -> W,
    log: &'l RefCell<Logged<W>>,
}

impl<W: Varyings> Shader for Noting<'_, W> {
    type Color = Rgb888;
    type Varyings = W;
    type Surface = ();
    type Face = usize;
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> W {
        (self.vertex)(vertex.position())
    }

    fn face(
        &self,
        (): &(),
        face: &MeshFace<'_>,
        _: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Rgb888, usize> {
        Face::Shaded(face.index())
    }

    fn pixel(&self, (): &(), &triangle: &usize, fragment: Fragment<Sample<Self>>) -> Rgb888 {
        self.log.borrow_mut().push((triangle, fragment));
        BACKGROUND
    }
}

/// A triangle on the screen: its place in the mesh's table, its corners in pixels, and what they
/// carry.
pub(super) type OnTheScreen<V> = (usize, [[f64; 2]; 3], [V; 3]);

/// What all pixels of both sides of a mesh see, and its triangles.
pub(super) fn noted<S: Subpixel, W: Varyings>(
    mesh: &Mesh<'_>,
    vertex: fn([i16; 3]) -> W,
    camera: &Camera<Perspective>,
) -> (Logged<W>, Vec<OnTheScreen<W::OnScreen>>) {
    let log = RefCell::new(vec![]);
    let object = Object::new(mesh, Noting { vertex, log: &log }).culled(CullNone);
    let seen = object.project_on_demand::<_, S, NoDepth>(camera, S::default()).unwrap();
    let mut triangles = vec![];
    let Ok(()) = seen.for_each_triangle(|index, corners| {
        let places = corners.map(|corner| {
            corner.position().unwrap().map(|c| f64::from(c) / f64::from(1 << S::BITS))
        });
        triangles.push((index, places, corners.map(ScreenVertex::varyings)));
        Ok::<(), Infallible>(())
    });
    NoDepth::frame(|frame| seen.draw(frame));
    (log.into_inner(), triangles)
}

/// The barycentric coordinates of a pixel's centre.
fn weights([a, b, c]: [[f64; 2]; 3], column: i32, row: i32) -> [f64; 3] {
    let p = [f64::from(column) + 0.5, f64::from(row) + 0.5];
    let area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    };
    [area(p, b, c), area(a, p, c), area(a, b, p)].map(|part| part / area(a, b, c))
}

/// Each number that a pixel sees lies on the plane through the numbers at the triangle's corners:
/// within the bound of its width, given in units.
fn is_on_the_plane<S: Subpixel, W: Varyings, const N: usize>(
    vertex: fn([i16; 3]) -> W,
    corner: fn(W::OnScreen) -> [f64; N],
    sample: fn(Sampled<W>) -> [f64; N],
    bounds: [f64; N],
) {
    let ball = ball();
    let mesh = ball.mesh();
    let (mut lowest, mut highest) = ([f64::MAX; N], [f64::MIN; N]);
    for eye in EYES {
        let (log, triangles) = noted::<S, W>(&mesh, vertex, &at(eye, DISPLAY));
        assert!(log.len() > 400, "{} pixels from {eye}", log.len());
        for (index, fragment) in log {
            // A triangle that is cut leaves several.
            let (places, corners) = triangles
                .iter()
                .filter(|triangle| triangle.0 == index)
                .map(|&(_, places, corners)| (places, corners.map(corner)))
                .find(|&(places, _)| {
                    weights(places, fragment.column, fragment.row).iter().all(|&w| w > -1e-9)
                })
                .unwrap();
            let weights = weights(places, fragment.column, fragment.row);
            let got = sample(fragment.varyings);
            for i in 0..N {
                let exact: f64 = (0..3).map(|k| weights[k] * corners[k][i]).sum();
                assert!(
                    (got[i] - exact).abs() < bounds[i],
                    "number {i} from {eye}: {} instead of {exact} at {:?}",
                    got[i],
                    (fragment.column, fragment.row)
                );
                lowest[i] = lowest[i].min(got[i]);
                highest[i] = highest[i].max(got[i]);
            }
        }
    }
    // The ball's positions are within 16,384 of the origin: each number has a good part of its
    // range.
    for i in 0..N {
        assert!(highest[i] - lowest[i] > 7000.0, "{} to {}", lowest[i], highest[i]);
    }
}

/// The value, half a unit below what a shader sees.
fn signed(value: I16F16) -> f64 {
    value.to_num::<f64>() - 0.5
}

fn unsigned(value: U16F16) -> f64 {
    value.to_num::<f64>() - 0.5
}

/// Of 16 bits, by the bound for 4,096 pixels. (Of 32 bits half a unit of rounding is added to n /
/// 2^18.)
const NARROW: f64 = 0.36;
const WIDE: f64 = 0.52;

#[test]
fn varyings_of_several_kinds_are_exact_planes() {
    fn in_precision<S: Subpixel>() {
        is_on_the_plane::<S, ([u16; 1], i16), 2>(
            |[x, y, _]| ([x as u16 ^ 0x8000], y.saturating_mul(2)),
            |([a], b)| [f64::from(a), f64::from(b)],
            |([a], b)| [unsigned(a), signed(b)],
            [NARROW; 2],
        );
        // Negative everywhere, of both signs, and of the whole width.
        is_on_the_plane::<S, ([i16; 2], u32), 3>(
            |[x, y, z]| ([x / 2 - 24_000, y], (z.saturating_mul(2) as u32 ^ 0x8000) << 16),
            |([a, b], c)| [f64::from(a), f64::from(b), f64::from(c)],
            |([a, b], c)| [signed(a), signed(b), f64::from(c)],
            [NARROW, NARROW, WIDE],
        );
        is_on_the_plane::<S, (i16, ([u32; 1], (u16, [i16; 1]))), 4>(
            |[x, y, z]| {
                (-x, ([u32::from(x as u16) ^ 0x8000], (y as u16 ^ 0x8000, [z / 2 - 24_000])))
            },
            |(a, ([b], (c, [d])))| [f64::from(a), f64::from(b), f64::from(c), f64::from(d)],
            |(a, ([b], (c, [d])))| [signed(a), f64::from(b), unsigned(c), signed(d)],
            [NARROW, WIDE, NARROW, NARROW],
        );
    }
    in_precision::<S4>();
    in_precision::<S8>();
}

/// A floor that runs from before the camera to behind it. Where the near plane cuts it, the
/// varyings are those of the cut: the distance, which the depth tells too.
#[test]
fn the_near_plane_cuts_signed_varyings() {
    let floor = Surface::new(
        vec![[-900, -150, 8000], [900, -150, 8000], [900, -150, -8000], [-900, -150, -8000]],
        vec![[0, 1, 2], [0, 2, 3]],
    )
    .scaled(-8);
    let near = 0.25;
    let lens = Perspective::new(Turn::degrees(70), Distance::from_num(near), Distance::lit("100"))
        .unwrap();
    let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, DISPLAY).unwrap();
    let mesh = floor.mesh();
    type Numbers = (i16, ([i16; 1], u32));
    let shader = By::<Numbers, Rgb888> {
        vertex: |[_, _, z]| (z, ([z - 20_000], (i32::from(z) + 100_000) as u32)),
        pixel: |_| BACKGROUND,
    };
    let object = Object::new(&mesh, shader);
    let seen = object.project_on_demand::<_, S8, u32>(&camera, S8).unwrap();
    let mut cut = 0;
    let Ok(()) = seen.for_each_triangle(|_, corners| {
        for corner in corners {
            let distance = near * 2f64.powi(32) / f64::from(corner.depth());
            // In quanta; the depth is within 2^-27, of 1 at the near plane.
            let z = -distance * 256.0;
            let (a, ([b], c)) = corner.varyings();
            for got in [f64::from(a), f64::from(b) + 20_000.0, f64::from(c) - 100_000.0] {
                assert!((got - z).abs() < 1.0, "{got} instead of {z}");
            }
            cut += u32::from(distance < 1.01 * near);
        }
        Ok::<(), Infallible>(())
    });
    assert!(cut >= 3, "{cut} corners lie on the near plane");
}

/// Tuples are pictures of the same pixels as arrays.
#[test]
fn tuples_equal_arrays_of_the_same_numbers() {
    fn equal<W: Varyings>(tuple: fn([i16; 3]) -> W, as_array: fn(Sampled<W>) -> [U16F16; 3]) {
        let ball = ball();
        let mesh = ball.mesh();
        for eye in EYES {
            let camera = at(eye, DISPLAY);
            let array = |p: [i16; 3]| p.map(|c| c as u16 ^ 0x8000);
            let (want, _) = noted::<S8, [u16; 3]>(&mesh, array, &camera);
            let (got, _) = noted::<S8, W>(&mesh, tuple, &camera);
            assert!(want.len() > 400, "{eye}");
            assert_eq!(got.len(), want.len(), "{eye}");
            for ((index, got), (wanted, want)) in got.into_iter().zip(want) {
                let place = (got.column, got.row);
                assert_eq!((index, place), (wanted, (want.column, want.row)), "{eye}");
                assert_eq!(as_array(got.varyings), want.varyings, "{eye}: {place:?}");
            }
        }
    }
    fn offset([x, y, z]: [i16; 3]) -> [u16; 3] {
        [x, y, z].map(|c| c as u16 ^ 0x8000)
    }
    equal::<([u16; 2], u16)>(
        |p| {
            let [x, y, z] = offset(p);
            ([x, y], z)
        },
        |([x, y], z)| [x, y, z],
    );
    equal::<(u16, (u16, u16))>(
        |p| {
            let [x, y, z] = offset(p);
            (x, (y, z))
        },
        |(x, (y, z))| [x, y, z],
    );
    // Signed numbers are the same ones, 2^15 less.
    equal::<([i16; 1], [i16; 2])>(
        |[x, y, z]| ([x], [y, z]),
        |([x], [y, z])| [x, y, z].map(|c| U16F16::from_bits(c.to_bits() as u32 ^ 0x8000_0000)),
    );
}
