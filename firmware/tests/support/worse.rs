//! The greater of two errors, from which no error that is not a number is lost.

/// The worse of two: `f64::max` takes the other where one is not a number.
pub fn worse(one: f64, other: f64) -> f64 {
    if other > one || other.is_nan() { other } else { one }
}
