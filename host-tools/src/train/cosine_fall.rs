//! A step size that falls along a half-wave of the cosine (Loshchilov & Hutter 2017, "SGDR", without restarts).

/// What the first step size is multiplied by after a share (0 … 1) of all steps: 1 at the beginning, 0 at the end.
pub fn cosine_fall(share: f32) -> f32 {
    0.5 * (1.0 + libm::cosf(std::f32::consts::PI * share))
}

#[cfg(test)]
mod tests {
    use super::cosine_fall;

    #[test]
    fn falls_from_one_to_zero() {
        assert_eq!(cosine_fall(0.0), 1.0);
        assert!((cosine_fall(0.5) - 0.5).abs() < 1e-6);
        assert!(cosine_fall(1.0).abs() < 1e-6);
    }
}
