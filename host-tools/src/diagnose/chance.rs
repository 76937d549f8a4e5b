//! Chance where many things are tried.

/// The chance that the best of `tried` independent things comes about that each has the chance `alone` of (Šidák):
/// 1 − (1 − p)^m, without losing a small p.
pub fn over_all(alone: f64, tried: usize) -> f64 {
    -(f64::ln_1p(-alone.clamp(0.0, 1.0 - 1e-12)) * tried as f64).exp_m1()
}
