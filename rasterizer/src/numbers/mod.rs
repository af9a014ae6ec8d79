//! Numbers for all other modules: Q formats, vectors, rotations, and the kernels behind them.
//!
//! | type | format | for |
//! |---|---|---|
//! | [`Scalar`] | Q16.16 | world coordinates |
//! | [`Turn`] | Q0.32 turns | angles |
//! | [`Rotation`] | Q2.30 | matrices whose rows have length one |
//! | [`Quaternion`] | Q2.30 | rotations about an axis, and ways between two |
//! | [`Matrix`] | Q16.16 | what stretches, mirrors or shears |
//! | [`Scale`] | 32-bit mantissa, exponent | the length of a mesh's quantum |
//!
//! The kernels have these errors, and tests check them: the reciprocal 2<sup>-27</sup> of its value
//! over all mantissas, the inverse square root 2<sup>-28</sup>, sine and cosine 2<sup>-28</sup>.
//! Rotations are orthonormal within 2<sup>-26</sup>.

pub(crate) mod codegen;
mod coordinate;
mod direction;
mod divide;
mod float;
mod instructions;
mod interchange;
mod length;
mod matrix;
mod quaternion;
mod reciprocal;
mod root;
mod rotation;
mod scale;
mod software;
mod subpixel;
mod turn;
mod vector;

pub use coordinate::Coordinate;
pub(crate) use direction::{Direction, dot_q15, inverse_square, unit_q15};
pub(crate) use divide::Divisor;
pub(crate) use float::Float;
pub(crate) use instructions::{
    HAS_LEADING_ZEROS, HAS_UNALIGNED_WORDS, IS_NARROW, at_most, divide, divide_small,
    few_leading_zeros, leading_zeros, mul_high, mul_high_unsigned, mul_q30, mul_q60, mul_wide,
    mul_wide_q30, normalised, not_negative, saturate, shifted,
};
pub(crate) use length::Scaled;
pub use matrix::Matrix;
pub use quaternion::Quaternion;
pub(crate) use reciprocal::Reciprocal;
pub(crate) use root::{inverse_square_root, unit};
pub use rotation::Rotation;
pub(crate) use rotation::cross;
pub use scale::Scale;
pub use subpixel::{S4, S8, Subpixel};
pub use turn::Turn;
pub(crate) use turn::{angle, cotangent_of_half};
pub use vector::{Scalar, Vec3};
