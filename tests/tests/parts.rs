//! Parts of a mesh from back to front: without depth and without sorting, the picture is that of a
//! depth buffer.

use embedded_graphics::pixelcolor::Rgb888;
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{Pose, Projection, ScreenVertex},
    mesh::{Material, Mesh, Parts, Positions, SeparatingPlane, Tables, Triangles},
    numbers::{Matrix, Rotation, S4, S8, Scalar, Scale, Subpixel, Turn, Vec3},
    output::Replace,
    scene::{Mode, Needs, Object},
    shade::{Shader, Unlit},
};
use rasterizer_tests::{
    Random, Surface,
    bands::{DISPLAY, Position, ROWS, Screen, picture},
    ends,
};

/// From the middle of a body to that of the next.
const STEP: i16 = 9000;

/// The eye far from all bodies, and near to them and between them, where the near plane cuts some.
const EYES: [Vec3; 5] = [
    Vec3::lit("0.1", "0.2", "3"),
    Vec3::lit("-0.1", "0.2", "1.7"),
    Vec3::lit("0.1", "0.1", "1.1"),
    Vec3::lit("0.1", "0.2", "0.6"),
    Vec3::lit("0.05", "0.25", "0.2"),
];

/// Convex bodies on a grid, and the planes between its layers.
struct Grid {
    /// Bodies along x, y and z.
    size: [i16; 3],
    positions: Vec<[i16; 3]>,
    triangles: Vec<[u16; 3]>,
    ends: Vec<u32>,
    planes: Vec<SeparatingPlane>,
}

impl Grid {
    fn new(size: [i16; 3], random: &mut Random) -> Self {
        let (positions, triangles, ends, planes) = (vec![], vec![], vec![], vec![]);
        let mut grid = Self { size, positions, triangles, ends, planes };
        grid.divide([0; 3], size, random);
        grid
    }

    /// Where the body lies whose place along an axis is `index`; halves lie between two.
    fn place(&self, axis: usize, index: f64) -> i16 {
        (f64::from(STEP) * (index - f64::from(self.size[axis] - 1) / 2.0)) as i16
    }

    /// Adds the bodies from one corner to another: those in front of a plane, then those behind it.
    fn divide(&mut self, from: [i16; 3], to: [i16; 3], random: &mut Random) {
        let axes = (0..3).filter(|&axis| to[axis] - from[axis] > 1).collect::<Vec<_>>();
        if axes.is_empty() {
            return self.add_body(from, random);
        }
        let axis = random.pick(&axes);
        let cut = random.within(i32::from(from[axis]) + 1, i32::from(to[axis]) - 1) as i16;
        let (mut below, mut above) = (to, from);
        (below[axis], above[axis]) = (cut, cut);
        let ([front, back], is_above) = if random.coin() {
            ([(above, to), (from, below)], true)
        } else {
            ([(from, below), (above, to)], false)
        };
        let count = |(from, to): ([i16; 3], [i16; 3])| {
            (0..3).map(|axis| to[axis] - from[axis]).product::<i16>() as u8
        };
        let first = self.ends.len() as u8;
        let middle = first + count(front);

        // In the box of the mesh: the smallest body reaches as far from its middle.
        let reach: [i16; 3] =
            std::array::from_fn(|axis| self.place(axis, f64::from(self.size[axis] - 1)) + 2000);
        let mut points = [reach.map(|reach| -reach); 3];
        for (point, other) in [(1, (axis + 1) % 3), (2, (axis + 2) % 3)] {
            points[point][other] = reach[other];
        }
        let along = self.place(axis, f64::from(cut) - 0.5);
        points.iter_mut().for_each(|point| point[axis] = along);
        if !is_above {
            points.reverse();
        }
        self.planes.push(SeparatingPlane::new(points, [first, middle, middle + count(back)]));
        self.divide(front.0, front.1, random);
        self.divide(back.0, back.1, random);
    }

    /// Adds a cube or an octahedron.
    fn add_body(&mut self, place: [i16; 3], random: &mut Random) {
        let half = random.within(2000, 4000) as i16;
        let body = if random.coin() { Surface::cube(half, 1) } else { octahedron(half) };
        let mesh = body.mesh();
        let tables = mesh.tables();
        let first = self.positions.len() as u16;
        let middle: [i16; 3] = std::array::from_fn(|axis| self.place(axis, f64::from(place[axis])));
        self.positions.extend((0..).map_while(|index| {
            let position = tables.positions.get(index)?;
            Some(std::array::from_fn(|axis| position[axis] + middle[axis]))
        }));
        self.triangles.extend((0..).map_while(|index| {
            Some(tables.triangles.get(index)?.map(|corner| corner as u16 + first))
        }));
        self.ends.push(self.triangles.len() as u32);
    }

    /// Materials whose runs begin and end anywhere in a part.
    fn materials(&self, random: &mut Random) -> Vec<Material> {
        let mut left = self.triangles.len() as i32;
        let mut materials = vec![];
        while left > 0 {
            let color = [(); 3].map(|()| random.bits() as u8);
            let length = random.within(0, 30).min(left);
            materials.push(Material::new(color, length as u32));
            left -= length;
        }
        materials
    }

    fn mesh<'a>(&'a self, materials: &'a [Material]) -> Mesh<'a> {
        Mesh::new_const(Tables {
            positions: Positions::I16(&self.positions),
            scale: Scale::new(1, -14),
            triangles: Triangles::U16(&self.triangles),
            materials,
            ..Tables::EMPTY
        })
    }
}

fn octahedron(half: i16) -> Surface {
    let positions =
        [[half, 0, 0], [0, half, 0], [0, 0, half], [-half, 0, 0], [0, -half, 0], [0, 0, -half]];
    // Of its eight corners of space, those with an odd number of negative sides are mirrored.
    let triangles = (0..8u16).map(|sides| {
        let corner = |axis| if sides >> axis & 1 == 0 { axis } else { axis + 3 };
        let [a, b, c] = [corner(0), corner(1), corner(2)];
        if sides.count_ones() % 2 == 0 { [a, b, c] } else { [a, c, b] }
    });
    Surface::new(positions.to_vec(), triangles.collect())
}

/// Checks the pictures of an object in parts, and returns in how many pixels that of the plain
/// table is wrong.
fn wrong_in_table_order<S: Subpixel, P: Projection, Sh, M>(
    object: &Object<'_, Sh, M>,
    camera: &Camera<P>,
    parts: &Parts<'_>,
    rows: u32,
) -> usize
where
    Sh: Shader<Color = Rgb888>,
    M: Mode<Blending = Replace>,
{
    // Too near for 8 bits is refused.
    let Ok(tested) = object.project_on_demand::<_, S, u32>(camera, S::default()) else { return 0 };
    let tested = picture::<u32>(ROWS, |frame| tested.draw(frame));
    let walked = object.project_on_demand::<_, S, NoDepth>(camera, S::default()).unwrap();
    let plain = picture::<NoDepth>(ROWS, |frame| walked.draw(frame));
    let walked = walked.in_parts(parts);
    let wrong = |picture: &Screen<Rgb888>| {
        tested.pixels.iter().zip(&picture.pixels).filter(|(a, b)| a != b).count()
    };
    assert_eq!(wrong(&picture::<NoDepth>(ROWS, |frame| walked.draw(frame))), 0, "on demand");
    assert_eq!(wrong(&picture::<NoDepth>(rows, |band| walked.draw(band))), 0, "{rows} rows");

    let mut stored = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; object.mesh().vertex_count()];
    let seen = object.project(camera, &mut stored).unwrap().in_parts(parts);
    assert_eq!(wrong(&picture::<NoDepth>(ROWS, |frame| seen.draw(frame))), 0, "stored");
    assert_eq!(wrong(&picture::<NoDepth>(rows, |band| seen.draw(band))), 0, "stored, {rows} rows");

    let mut words = vec![!0; Needs::of(object.mesh(), DISPLAY.size, rows).bin_words];
    let binned = object.project_on_demand::<_, S, NoDepth>(camera, S::default()).unwrap();
    let binned = binned.binned(rows, &mut words).unwrap().in_parts(parts);
    assert!(binned.order().parts().eq(walked.order().parts()));
    assert_eq!(wrong(&picture::<NoDepth>(rows, |band| binned.draw(band))), 0, "binned, {rows}");
    wrong(&plain)
}

/// Random grids in random poses, from outside and from between the bodies.
fn pictures_are_those_of_depth<S: Subpixel>(seed: u64) {
    let mut random = Random::new(seed);
    let mut wrong = [0; 3];
    for round in 0..60 {
        let size = match round % 4 {
            0 => [1, 1, 2],
            1 => [3; 3],
            _ => [(); 3].map(|()| random.within(1, 3) as i16),
        };
        let grid = Grid::new(size, &mut random);
        let materials = grid.materials(&mut random);
        let mesh = grid.mesh(&materials);
        let parts = Parts::new(&mesh, &grid.ends, &grid.planes).unwrap();
        let pose = Pose::rotated(ends::rotation(&mut random));
        let plain = Object::new(&mesh, Position).posed(pose);
        let flat = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(pose);
        let signs = [(); 3].map(|()| random.pick(&[Scalar::ONE, Scalar::NEG_ONE]));
        let mirrored = flat.shaped(&Matrix::scaling(signs[0], signs[1], signs[2]));
        let rows = random.pick(&[1, 5, 16, 46]);

        let [near, far] = [Distance::lit("0.04"), Distance::lit("10")];
        let lens = Perspective::new(Turn::degrees(70), near, far).unwrap();
        let camera = Camera::at(random.pick(&EYES), Rotation::IDENTITY, lens, DISPLAY).unwrap();
        wrong[0] += wrong_in_table_order::<S, _, _, _>(&plain, &camera, &parts, rows);
        wrong[1] += wrong_in_table_order::<S, _, _, _>(&mirrored, &camera, &parts, rows);
        let lens = Orthographic::new(Distance::lit("1.9"), near, far).unwrap();
        let camera = Camera::at(EYES[0], Rotation::IDENTITY, lens, DISPLAY).unwrap();
        wrong[2] += wrong_in_table_order::<S, _, _, _>(&flat, &camera, &parts, rows);
    }
    // Of 60 x 2867 pixels.
    assert!(wrong.iter().all(|&wrong| wrong > 2000), "{wrong:?}");
}

#[test]
fn pictures_are_those_of_depth_with_4_bits() {
    pictures_are_those_of_depth::<S4>(51);
}

#[test]
fn pictures_are_those_of_depth_with_8_bits() {
    pictures_are_those_of_depth::<S8>(52);
}
