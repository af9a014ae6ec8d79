//! The picture of a crate's side: a frame of boards, planks, and a board across them.
//!
//! Only sums and products of integers and of f64, which are the same on every machine.

/// The width and height in pixels.
pub(super) const SIDE: u32 = 128;

/// The width of the frame's boards.
pub(super) const FRAME: u32 = 20;

/// The bytes of the PNG file.
pub(super) fn png() -> Vec<u8> {
    let pixels = (0..SIDE as i32).flat_map(|y| (0..SIDE as i32).flat_map(move |x| pixel(x, y)));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIDE, SIDE);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    // Writing to a vector cannot fail.
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(&pixels.collect::<Vec<u8>>())?;
        writer.finish()
    });
    debug_assert!(written.is_ok(), "a picture of a known size");
    bytes
}

/// A place on a board.
struct Place {
    /// Its number, for the grain.
    board: i32,
    /// Pixels along the grain and across it.
    along: i32,
    across: i32,
    /// Pixels to the board's nearest long edge.
    edge: i32,
    /// The colour of its wood.
    color: [f64; 3],
}

const PALE: [f64; 3] = [196.0, 148.0, 92.0];
const DARK: [f64; 3] = [158.0, 108.0, 62.0];
const PLANK: i32 = 22;
/// Half the width of the board across, measured along a row.
const BRACE: i32 = 15;

fn place(x: i32, y: i32) -> Place {
    let (frame, last) = (FRAME as i32, SIDE as i32 - 1);
    let [right, below] = [last - x, last - y];
    let board = |board, along, across: i32, width: i32, color| {
        let edge = across.min(width - 1 - across);
        Place { board, along, across, edge, color }
    };
    if y < frame {
        board(1, x, y, frame, PALE)
    } else if below < frame {
        board(2, x, below, frame, PALE)
    } else if x < frame {
        board(3, y, x, frame, PALE)
    } else if right < frame {
        board(4, y, right, frame, PALE)
    } else if (x - below).abs() <= BRACE {
        let across = x - below + BRACE;
        board(5, (x + below) / 2, across, 2 * BRACE + 1, PALE)
    } else {
        let plank = (x - frame) / PLANK;
        board(6 + plank, y, (x - frame) % PLANK, PLANK, DARK)
    }
}

fn pixel(x: i32, y: i32) -> [u8; 3] {
    let place = place(x, y);
    let last = SIDE as i32 - 1;
    // Two nails in each corner of the frame, and one in the middle of each board.
    let fold = |c: i32| c.min(last - c);
    let nails = [(6, 13), (13, 6), (10, 64), (64, 10)];
    for (nail_x, nail_y) in nails {
        let (dx, dy) = (fold(x) - nail_x, fold(y) - nail_y);
        if dx * dx + dy * dy <= 4 {
            return if dx * dx + dy * dy <= 1 { [138, 134, 130] } else { [84, 78, 74] };
        }
    }
    let (along, across) = (f64::from(place.along), f64::from(place.across));
    // Long streaks, fine ones, and knots that bend them.
    let bend = 3.0 * noise(along / 24.0, across / 9.0, place.board + 40);
    let streaks = noise(along / 40.0, (across + bend) / 2.2, place.board);
    let fine = noise(along / 11.0, across, place.board + 20);
    let tone = noise(0.5, 0.5, place.board * 7);
    let grain = 0.80 + 0.24 * streaks + 0.10 * fine + 0.10 * tone;
    let edge = match place.edge {
        0 => 0.45,
        1 => 0.85,
        2 => 1.06,
        _ => 1.0,
    };
    place.color.map(|c| (c * grain * edge).clamp(0.0, 255.0) as u8)
}

/// Smooth noise from 0 to 1.
fn noise(x: f64, y: f64, seed: i32) -> f64 {
    let (left, top) = (x.floor(), y.floor());
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (u, v) = (smooth(x - left), smooth(y - top));
    let value = |dx: i32, dy: i32| hash(left as i32 + dx, top as i32 + dy, seed);
    let row = |dy| value(0, dy) * (1.0 - u) + value(1, dy) * u;
    row(0) * (1.0 - v) + row(1) * v
}

/// A number from 0 to 1 that looks random.
fn hash(x: i32, y: i32, seed: i32) -> f64 {
    let mut bits = (x as u32).wrapping_mul(0x9E37_79B1)
        ^ (y as u32).wrapping_mul(0x85EB_CA77)
        ^ (seed as u32).wrapping_mul(0xC2B2_AE3D);
    for _ in 0..2 {
        bits ^= bits >> 15;
        bits = bits.wrapping_mul(0x2C1B_3C6D);
        bits ^= bits >> 13;
    }
    f64::from(bits >> 8) / f64::from(1 << 24)
}
