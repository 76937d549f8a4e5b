//! Chance where many things are tried, or where a noise is estimated beside what is tried.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

/// ln of a ratio of squares beyond which nothing more is learned.
const GREATEST_LN_RATIO: f64 = 300.0;

/// By how much a sum of squares is less, over the variance of the noise that the rest tells with so many degrees of freedom, where the logarithm
/// of the ratio of the two sums is `ln_ratio`.
pub fn squares_gained(ln_ratio: f64, freedom: f64) -> f64 {
    // Of two sums of nothing the ratio is no number, and nothing is gained.
    if ln_ratio.is_nan() { 0.0 } else { freedom * ln_ratio.min(GREATEST_LN_RATIO).exp_m1() }
}

/// The chance that so many parameters that change nothing lessen squares by as much, over the variance of a noise that is known with so many
/// degrees of freedom: of Fisher's ratio. 1 where the squares are no number.
pub fn beside_noise(squares: f64, parameters: f64, freedom: f64) -> f64 {
    if squares.is_nan() {
        return 1.0;
    }
    FisherSnedecor::new(parameters, freedom).map_or(1.0, |law| law.sf(squares / parameters))
}

/// The chance that a sum of squares of so many independent errors of known size is as large: of χ². 1 where there are none.
pub fn of_known_noise(squares: f64, count: f64) -> f64 {
    ChiSquared::new(count).map_or(1.0, |law| law.sf(squares))
}

/// The chance that the best of `tried` independent things comes about that each has the chance `alone` of (Šidák):
/// 1 − (1 − p)^m, without losing a small p.
pub fn over_all(alone: f64, tried: usize) -> f64 {
    -(f64::ln_1p(-alone.clamp(0.0, 1.0 - 1e-12)) * tried as f64).exp_m1()
}
