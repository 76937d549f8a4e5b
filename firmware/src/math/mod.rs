//! Elementary functions in single precision for the flight path.

mod limit;

pub use limit::limit;

/// Sine and cosine of `x` in radians.
pub fn sin_cos(x: f32) -> (f32, f32) {
    libm::sincosf(x)
}
/// Arc cosine in radians.
pub fn acos(x: f32) -> f32 {
    libm::acosf(x)
}
/// e to the power of `x`.
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}
/// Natural logarithm.
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}
/// `x` to the power of `y`, x ≥ 0.
pub fn powf(x: f32, y: f32) -> f32 {
    libm::powf(x, y)
}
/// Square root.
pub fn sqrt(x: f32) -> f32 {
    libm::sqrtf(x)
}
/// Magnitude.
pub fn abs(x: f32) -> f32 {
    f32::from_bits(x.to_bits() & 0x7fff_ffff)
}
/// Hyperbolic tangent.
pub fn tanh(x: f32) -> f32 {
    libm::tanhf(x)
}
