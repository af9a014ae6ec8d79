//! Pixels of less than a byte, in bytes.

use embedded_graphics_core::{
    geometry::Size,
    pixelcolor::{PixelColor, raw::RawData},
};

use super::fill::fill_bytes;
use crate::numbers::divide;

/// A colour of 1, 2 or 4 bits: `BinaryColor`, `Gray2`, `Gray4`, and any other whose raw data has as
/// few.
pub trait PackedColor: PixelColor {
    /// The bits of a pixel.
    const BITS: u32;

    /// The colour's bits, above which all are 0.
    fn to_bits(self) -> u8;

    /// The colour of the lowest bits; those above them are ignored.
    fn from_bits(bits: u8) -> Self;
}

impl<C> PackedColor for C
where
    C: PixelColor<Raw: RawData<Storage = u8>> + From<<C as PixelColor>::Raw>,
    <C as PixelColor>::Raw: From<C> + From<u8>,
{
    const BITS: u32 = {
        let bits = <C::Raw as RawData>::BITS_PER_PIXEL as u32;
        assert!(bits == 1 || bits == 2 || bits == 4, "a packed pixel has 1, 2 or 4 bits");
        bits
    };

    #[inline(always)]
    fn to_bits(self) -> u8 {
        <C::Raw>::from(self).into_inner()
    }

    #[inline(always)]
    fn from_bits(bits: u8) -> Self {
        Self::from(<C::Raw>::from(bits))
    }
}

/// How pixels of less than a byte lie in bytes: [`InRows`] or [`InPages`].
pub trait BitOrder: Order {}

/// Side by side in a byte, the leftmost pixel in its most significant bits; each row begins with a
/// byte. This is the order of `ImageRaw` of embedded-graphics, and of most e-paper and LCD
/// controllers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct InRows;

/// One above the other, eight pixels of one bit in a byte, the uppermost one in its least
/// significant bit; the bytes of eight rows, a *page*, lie from left to right. This is the memory
/// of the OLED controllers SSD1306, SSD1309 and SH1106: they take the bytes of such a frame as they
/// are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct InPages;

impl BitOrder for InRows {}
impl BitOrder for InPages {}

mod private {
    use super::PackedColor;

    /// Where a pixel lies. Columns and rows count from the upper left corner of a rectangle.
    pub trait Order {
        /// Whether the pixels of a byte lie one above the other.
        const IS_UPRIGHT: bool;

        /// A pixel's byte, and how far its bits are shifted in it.
        fn place<C: PackedColor>(column: u32, row: u32, width: u32) -> (usize, u32);

        /// Sets the pixels of a row from a column to another to the colour whose bits `pattern`
        /// repeats.
        fn fill<C: PackedColor>(
            bytes: &mut [u8],
            columns: [u32; 2],
            row: u32,
            width: u32,
            pattern: u8,
        );
    }
}

pub(super) use private::Order;

/// Some bits of a byte.
#[inline(always)]
pub(super) const fn with_bits(byte: u8, mask: u8, bits: u8) -> u8 {
    byte & !mask | bits & mask
}

/// The bits of one pixel, at the lower end of a byte.
#[inline(always)]
pub(super) const fn pixel_mask<C: PackedColor>() -> u8 {
    (1 << C::BITS) - 1
}

/// The columns and rows of pixels that share a byte.
const fn pixels_of_byte<C: PackedColor, O: BitOrder>() -> [u32; 2] {
    if O::IS_UPRIGHT {
        assert!(C::BITS == 1, "pages have pixels of one bit");
        [1, 8]
    } else {
        [8 / C::BITS, 1]
    }
}

/// The bytes of a rectangle's pixels.
#[inline(always)]
pub(super) const fn bytes_of<C: PackedColor, O: BitOrder>(size: Size) -> usize {
    let [columns, rows] = const { pixels_of_byte::<C, O>() };
    size.width.div_ceil(columns) as usize * size.height.div_ceil(rows) as usize
}

/// The number of whole rows that `bytes` bytes hold at this width, which is not 0.
pub(super) const fn rows_of<C: PackedColor, O: BitOrder>(bytes: usize, width: u32) -> u32 {
    let [columns, rows] = const { pixels_of_byte::<C, O>() };
    divide(bytes as u32, width.div_ceil(columns)) * rows
}

/// The rows of pixels that share a byte.
pub(super) const fn rows_of_byte<C: PackedColor, O: BitOrder>() -> u32 {
    pixels_of_byte::<C, O>()[1]
}

impl Order for InRows {
    const IS_UPRIGHT: bool = false;

    #[inline(always)]
    fn place<C: PackedColor>(column: u32, row: u32, width: u32) -> (usize, u32) {
        let bit = column * C::BITS;
        let stride = width.div_ceil(8 / C::BITS);
        ((row * stride + bit / 8) as usize, 8 - C::BITS - bit % 8)
    }

    #[inline(always)]
    fn fill<C: PackedColor>(
        bytes: &mut [u8],
        columns: [u32; 2],
        row: u32,
        width: u32,
        pattern: u8,
    ) {
        let row = row * width.div_ceil(8 / C::BITS);
        let [start, end] = columns.map(|column| column * C::BITS);
        // The bits of the first byte from the first pixel on, and of the last byte before `end`.
        let (head, tail) = (0xFF_u8 >> (start % 8), !(0xFF_u8 >> (end % 8)));
        let (first, last) = ((row + start / 8) as usize, (row + end / 8) as usize);
        let mut set = |at: usize, mask: u8| {
            if let Some(byte) = bytes.get_mut(at) {
                *byte = with_bits(*byte, mask, pattern);
            }
        };
        if first == last {
            set(first, head & tail);
            return;
        }
        set(first, head);
        if tail != 0 {
            set(last, tail);
        }
        fill_bytes(bytes.get_mut(first + 1..last).unwrap_or_default(), pattern);
    }
}

impl Order for InPages {
    const IS_UPRIGHT: bool = true;

    #[inline(always)]
    fn place<C: PackedColor>(column: u32, row: u32, width: u32) -> (usize, u32) {
        ((row / 8 * width + column) as usize, row % 8)
    }

    #[inline(always)]
    fn fill<C: PackedColor>(
        bytes: &mut [u8],
        [start, end]: [u32; 2],
        row: u32,
        width: u32,
        pattern: u8,
    ) {
        let page = row / 8 * width;
        let mask = 1 << (row % 8);
        let run = (page + start) as usize..(page + end) as usize;
        for byte in bytes.get_mut(run).unwrap_or_default() {
            *byte = with_bits(*byte, mask, pattern);
        }
    }
}
