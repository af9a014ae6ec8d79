//! A covered pixel centre before it has a colour.

/// What a triangle has at a pixel centre that it covers. A shading closure turns it into a colour
/// (red, green, blue in 0..=255), or into `None` to discard the fragment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<const N: usize> {
    /// Column and row, from the top left corner of the picture.
    pub pixel: [usize; 2],
    /// The first and the last column of the picture that the triangle covers in this row.
    pub span: [usize; 2],
    /// Number of the triangle; pieces of a clipped triangle share its number.
    pub triangle: usize,
    /// Depth at the pixel centre; larger is nearer.
    pub depth: f64,
    /// The interpolated varyings.
    pub varyings: [f64; N],
    /// Their exact derivatives to the right, per pixel.
    pub per_column: [f64; N],
    /// Their exact derivatives downwards, per pixel.
    pub per_row: [f64; N],
}
