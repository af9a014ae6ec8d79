//! Objects whose shape is chosen at run time, against those of the shapes' own types: the same
//! vertices, pixels and refusals.

use rasterizer::{
    geometry::{self, AnyShape, ClipPlanes, Clipping, CullBack, Plane},
    raster::NoBias,
    scene::Modes,
    shade::Lamp,
};

use super::*;

/// Draws an object in its own type and in the type of any shape. Returns whether it is drawn.
fn is_drawn_alike<'a, Sh, L, G>(
    object: Object<'a, Sh, Modes<CullBack, L, Replace, NoBias, G>>,
    distance: &str,
) -> [bool; 2]
where
    Sh: Shader<Color = Rgb888> + Clone,
    L: Clipping,
    G: geometry::Shape + Into<AnyShape<'a>>,
{
    let (any, camera) = (object.clone().in_any_shape(), camera(distance));
    let (coarse, fine) = (drawn::<S4, _, _>(&object, &camera), drawn::<S8, _, _>(&object, &camera));
    assert!(coarse == drawn::<S4, _, _>(&any, &camera), "S4 from {distance}");
    assert!(fine == drawn::<S8, _, _>(&any, &camera), "S8 from {distance}");
    [coarse, fine].map(|picture| picture.is_some_and(|all| all.iter().any(|&p| p != Rgb888::BLACK)))
}

#[test]
fn pictures_are_those_of_the_own_type() {
    let (from, to) = (Shape::ball(), Shape::twisted());
    let (ball, further) = (from.mesh(), [to.keyframe()]);
    let keyframes = Keyframes::new(&ball, &further).unwrap();
    let tween = keyframes.between(0, 1, Progress::lit("0.4")).unwrap();
    let pose = Pose::rotated(Rotation::about_y(Turn::degrees(25)));
    let half = Scalar::lit("0.5");
    let mirror = Matrix::scaling(-half, Scalar::ONE, half);
    let cut = ClipPlanes::in_world([Plane::new(Vec3::lit("1", "2", "1"), Scalar::lit("-0.2"))]);
    // Positions of a quarter of their range leave two bits, which a matrix uses.
    let mut little = Shape::ball();
    little.positions.iter_mut().for_each(|position| *position = position.map(|c| c / 4));
    let little = little.mesh();
    // It lights vertices in the changed mesh, whose scale is another.
    let long = Matrix::scaling(Scalar::ONE, Scalar::lit("-1.9"), Scalar::ONE);
    let lamp = Lamp::new(Vec3::lit("0.9", "0.8", "1.2"), Distance::lit("0.7"), Level::lit("0.9"));
    let mut drawn = Vec::new();
    for distance in ["5", "1.6", "1.25", "0.9"] {
        let light = Phong::new(LIGHT);
        drawn.extend(is_drawn_alike(Object::new(&ball, light).posed(pose), distance));
        let textured = TexturedGouraud::new(&TEXTURES, LIGHT);
        let shaped = Object::new(&ball, textured).posed(pose).shaped(&mirror);
        drawn.extend(is_drawn_alike(shaped, distance));
        let larger = pose.scaled(const { Distance::lit("4") });
        let lit = Object::new(&little, Gouraud::new(lamp)).posed(larger).shaped(&long);
        drawn.extend(is_drawn_alike(lit, distance));
        let morphed = Object::morphed(&tween, Flat::new(LIGHT)).posed(pose);
        drawn.extend(is_drawn_alike(morphed, distance));
        drawn.extend(is_drawn_alike(morphed.clipped(cut), distance));
        drawn.extend(is_drawn_alike(morphed.shaped(&mirror), distance));
        // A matrix replaces one that the shape has.
        let again = Object::morphed(&tween, Gouraud::<Rgb888>::new(LIGHT)).posed(pose);
        let any = again.in_any_shape().shaped(&Matrix::IDENTITY).shaped(&mirror);
        assert!(any.in_any_shape() == again.shaped(&mirror).in_any_shape());
    }
    let refused = drawn.iter().filter(|&&is_drawn| !is_drawn).count();
    assert!((1..=10).contains(&refused), "{refused} of {}", drawn.len());
}

/// The places of vertices; `None` if the object is refused.
fn placed<S, P, M>(
    object: &Object<'_, Unlit<Rgb888>, M>,
    camera: &Camera<P>,
) -> Option<Vec<Placed<S>>>
where
    S: Subpixel,
    P: Projection,
    M: Mode,
{
    let mut storage = vec![Placed::<S>::EMPTY; object.mesh().vertex_count()];
    object.project(camera, &mut storage).ok()?;
    Some(storage)
}

#[test]
fn vertices_lie_where_those_of_the_own_type_lie() {
    fn compare<P: Projection>(stage: &Stage, matrix: &Matrix, camera: &Camera<P>) -> usize {
        let mesh = stage.surface.mesh();
        let plain = Object::new(&mesh, Unlit::new()).posed(stage.pose);
        let shaped = plain.shaped(matrix);
        let any = [plain.in_any_shape(), shaped.in_any_shape()];
        let own = [placed::<S8, _, _>(&plain, camera), placed::<S8, _, _>(&shaped, camera)];
        for (own, any) in own.iter().zip(&any) {
            assert!(*own == placed::<S8, _, _>(any, camera), "{stage:?} {matrix:?}");
        }
        own.iter().flatten().count()
    }
    let (mut random, mut drawn) = (Random::new(46), [0; 2]);
    for _ in 0..10_000 {
        let stage = ends::stage(&mut random);
        let viewport = ends::viewport(&mut random);
        let range = random.within(8, 24);
        let mut entry = || Scalar::from_bits(random.bits() as i32 >> range);
        let matrix = Matrix::from_rows([(); 3].map(|()| [entry(), entry(), entry()]));
        let lens = ends::perspective(&mut random);
        drawn[0] += compare(&stage, &matrix, &stage.camera(lens, viewport));
        let lens = ends::orthographic(&mut random);
        drawn[1] += compare(&stage, &matrix, &stage.camera(lens, viewport));
    }
    // Of twice 10,000 each, many are refused: they are at the ends of all ranges.
    assert!(drawn.iter().all(|&count| (2000..19_000).contains(&count)), "{drawn:?}");
}
