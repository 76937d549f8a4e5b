//! Bounds by comparison: unlike the methods of `f32`, without a panic and with the same bits on every target.

/// `x` inside `low` … `high`; NaN becomes `low`.
pub fn limit(x: f32, low: f32, high: f32) -> f32 {
    if x > high {
        high
    } else if x > low {
        x
    } else {
        low
    }
}
