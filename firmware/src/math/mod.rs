//! Elementary functions in single precision for the flight path.
//!
//! The floating-point unit of a Cortex-M4F is single precision: an f64 operation is a library call of some fifty
//! instructions. These functions use f32 addition, multiplication, division and square root, and 32-bit integers,
//! nothing else: no f64, no 64-bit product, no fused multiply-add, no loop. Each of those operations is correctly rounded
//! everywhere, so host and target give the same bits; so is each half of the target's chained multiply-accumulate
//! (`vmla`), which the compiler may use. That takes the reset state of the floating-point control register:
//! round to nearest, subnormals kept.
//!
//! An argument that is NaN gives NaN, except to [`limit()`], [`octaves()`] and [`of_octaves`], which give a number. The sign
//! and payload of a NaN are the one thing that may differ between machines. No argument panics.
//!
//! Errors are in ulp, the distance between the two f32 beside the exact result. They were measured over every f32 of
//! the stated range by `tests/math_exhaustive.rs`, which fails where a result is worse than stated here. Coefficients
//! are our own minimax fits: linear programming on 600 to 3000 Chebyshev nodes in 40-digit arithmetic, each
//! coefficient rounded to f32 in turn from the lowest degree, the rest refitted. Each file states interval, weight, error.
//!
//! What the host computes in double precision is in [`double`].

pub mod double;
mod exp;
mod hyperbolic;
mod limit;
mod ln;
mod octaves;
mod power;
mod rounding;
mod square_root;
mod trigonometric;

pub use exp::exp;
pub(crate) use exp::power_of_two;
pub use hyperbolic::{bipolar_sigmoid, tanh};
pub use limit::limit;
pub use ln::ln;
pub use octaves::{octaves, of_octaves};
pub use power::powf;
pub use square_root::sqrt;
pub use trigonometric::{acos, sin_cos, sin_cos_of_slope};

/// Whether `from` ≤ |x| < `to`, of two numbers of zero or more: one comparison, false for NaN.
///
/// Below a magnitude where the first term of a series is all, the functions leave by this test. On the target that saves
/// little, but the powers of tiny arguments are subnormal or vanish, which costs a desktop processor hundreds of cycles.
#[inline]
const fn magnitude_between(x: f32, from: f32, to: f32) -> bool {
    let magnitude = x.to_bits() & 0x7fff_ffff;
    magnitude.wrapping_sub(from.to_bits()) < to.to_bits() - from.to_bits()
}

/// Magnitude, exact. The sign of a NaN is cleared as well.
#[inline]
pub const fn abs(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0x7fff_ffff)
}
