//! A varying that is stepped in pieces of a span.

use super::{varyings::noted, *};

/// A `u16` whose spans come in pieces of five pixels. With `HOLDS` a piece keeps the value of its
/// first pixel, otherwise it is stepped as a `u16` is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stepped<const HOLDS: bool>(u16);

/// The pixels of a piece.
const PIECE: usize = 5;

impl<const HOLDS: bool> Varyings for Stepped<HOLDS> {
    type OnScreen = Self;

    fn lerp(self, other: Self, t: u32) -> Self {
        Self(self.0.lerp(other.0, t))
    }

    fn on_screen(self, _: InverseW) -> Self {
        self
    }
}

/// The pieces after a span's first one.
struct Pieces<const HOLDS: bool> {
    first: u32,
    step: u32,
    pixels: usize,
}

impl<const HOLDS: bool> Iterator for Pieces<HOLDS> {
    type Item = Piece<u32>;

    fn next(&mut self) -> Option<Piece<u32>> {
        let pixels = self.pixels.min(PIECE);
        let piece = Piece { first: self.first, step: if HOLDS { 0 } else { self.step }, pixels };
        self.pixels -= pixels;
        self.first = self.first.wrapping_add(self.step.wrapping_mul(pixels as u32));
        (pixels > 0).then_some(piece)
    }
}

impl<const HOLDS: bool> Interpolate for Stepped<HOLDS> {
    const ZERO: Self = Self(0);

    type Field = Plane<u32>;
    type Walk = u32;
    type Rest = Pieces<HOLDS>;
    type Sample = U16F16;

    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u32> {
        u16::plane(setup, quick, corners.map(|corner| corner.0))
    }

    fn whole(_: &Plane<u32>, _: [i32; 2], _: usize) -> Option<Piece<u32>> {
        None
    }

    fn walk(
        plane: &Plane<u32>,
        [address, row]: [i32; 2],
        pixels: usize,
    ) -> (Piece<u32>, Pieces<HOLDS>) {
        let (first, step) = (plane.at(address, row), plane.per_column);
        let mut pieces = Pieces { first, step, pixels };
        (pieces.next().unwrap(), pieces)
    }

    fn sample(value: u32) -> U16F16 {
        u16::sample(value)
    }
}

/// What pixels see of a varying in pieces, beside a plain one before and after it.
#[test]
fn a_varying_in_pieces_is_defined_by_them() {
    fn number([x, _, _]: [i16; 3]) -> u16 {
        x as u16 ^ 0x8000
    }
    fn other([_, y, _]: [i16; 3]) -> u16 {
        y as u16 ^ 0x8000
    }
    type Tuple = (Stepped<true>, (u16, Stepped<false>));
    let ball = ball();
    let mesh = ball.mesh();
    let mut long = 0;
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let (plain, _) = noted::<S8, [u16; 2]>(&mesh, |p| [number(p), other(p)], &camera);
        let (stepped, _) = noted::<S8, Stepped<false>>(&mesh, |p| Stepped(number(p)), &camera);
        let (held, _) = noted::<S8, Stepped<true>>(&mesh, |p| Stepped(number(p)), &camera);
        let (tuple, _) = noted::<S8, Tuple>(
            &mesh,
            |p| (Stepped(number(p)), (other(p), Stepped(other(p)))),
            &camera,
        );
        let lengths = [stepped.len(), held.len(), tuple.len()];
        assert!(plain.len() > 400 && lengths == [plain.len(); 3], "{lengths:?} from {eye}");
        // The first pixel of the piece at hand, and that of the span.
        let (mut piece, mut start) = (0, 0);
        for (index, (triangle, fragment)) in plain.iter().enumerate() {
            let place = (triangle, fragment.column, fragment.row);
            let is_next = index.checked_sub(1).is_some_and(|before| {
                let (same, before) = &plain[before];
                (same, before.column + 1, before.row) == place
            });
            if !is_next {
                (piece, start) = (index, index);
            } else if (index - start) % PIECE == 0 {
                piece = index;
                long += 1;
            }
            let [number, other] = fragment.varyings;
            let [first, _] = plain[piece].1.varyings;
            let of = |triangle, column, row| (triangle, column, row);
            let (triangle, fragment) = &stepped[index];
            assert_eq!(of(triangle, fragment.column, fragment.row), place, "{eye}");
            assert_eq!(fragment.varyings, number, "{eye}: {place:?}");
            let (triangle, fragment) = &held[index];
            assert_eq!(of(triangle, fragment.column, fragment.row), place, "{eye}");
            assert_eq!(fragment.varyings, first, "{eye}: {place:?}");
            let (triangle, fragment) = &tuple[index];
            assert_eq!(of(triangle, fragment.column, fragment.row), place, "{eye}");
            assert_eq!(fragment.varyings, (first, (other, other)), "{eye}: {place:?}");
        }
    }
    assert!(long > 100, "{long} pieces after the first");
}

/// All 16 bits of a number.
fn shown(value: U16F16) -> Rgb888 {
    let [high, low] = value.to_num::<u16>().to_be_bytes();
    Rgb888::new(high, low, 9)
}

/// A varying in pieces gives one picture in all targets: that of a plain number if it is stepped
/// like one.
#[test]
fn targets_agree_on_a_varying_in_pieces() {
    fn number([x, y, _]: [i16; 3]) -> u16 {
        (x / 2 + y / 3) as u16 ^ 0x8000
    }
    let cube = cube();
    let mesh = cube.mesh();
    let plain = By::<u16, Rgb888> { vertex: number, pixel: |seen| shown(seen.varyings) };
    let stepped = By::<Stepped<false>, Rgb888> {
        vertex: |position| Stepped(number(position)),
        pixel: |seen| shown(seen.varyings),
    };
    let held = By::<(u16, Stepped<true>), Rgb888> {
        vertex: |position| (7, Stepped(number(position))),
        pixel: |seen| shown(seen.varyings.1),
    };
    for eye in ["3", "2.4"] {
        let camera = at(eye, DISPLAY);
        let object = Object::new(&mesh, plain).posed(turned());
        let seen = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let want = u16::frame(|frame| seen.draw(frame));

        let object = Object::new(&mesh, stepped).posed(turned());
        let seen = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        assert!(u16::frame(|frame| seen.draw(frame)) == want, "{eye}");
        bands_equal::<u16>(&want, |band| seen.draw(band));
        let seen = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
        assert!(NoDepth::frame(|frame| seen.draw(frame)).color == want.color, "{eye}");
        bands_equal::<NoDepth>(&want, |band| seen.draw(band));
        assert!(direct(&object, eye) == want.color, "{eye}");

        let object = Object::new(&mesh, held).posed(turned());
        let seen = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let in_steps = u16::frame(|frame| seen.draw(frame));
        assert!(in_steps.depth == want.depth && in_steps.color != want.color, "{eye}");
        bands_equal::<u16>(&in_steps, |band| seen.draw(band));
        let seen = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
        assert!(NoDepth::frame(|frame| seen.draw(frame)).color == in_steps.color, "{eye}");
        assert!(direct(&object, eye) == in_steps.color, "{eye}");
    }
}
