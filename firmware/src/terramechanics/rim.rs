//! Points on the rim, measured from the entry.

use crate::scalar::Scalar;

/// Sine and cosine of the entry angle θ₁: all that a point on the rim is measured from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rim<S> {
    sin_entry: S,
    cos_entry: S,
}

/// A point on the rim at the angle θ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RimPoint<S> {
    /// θ₁ − θ, rad.
    pub from_entry_rad: S,
    /// sin θ.
    pub sin: S,
    /// cos θ.
    pub cos: S,
    /// cos θ − cos θ₁: how far the point has sunk, in radii.
    pub sunk: S,
    /// sin θ₁ − sin θ: how far behind the entry the point is, in radii.
    pub behind: S,
}

impl<S: Scalar> Rim<S> {
    /// The rim with its entry at `entry_rad`.
    pub fn new(entry_rad: S) -> Self {
        let (sin_entry, cos_entry) = entry_rad.sin_cos();
        Self { sin_entry, cos_entry }
    }

    /// The point at θ₁ − `from_entry_rad`.
    ///
    /// Both differences are taken as products, so that neither loses digits near the entry; one sine and cosine serve all.
    // The target has too few registers for a copy in every place that uses it.
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub fn point(&self, from_entry_rad: S) -> RimPoint<S> {
        let (sin_half, cos_half) = from_entry_rad.scaled(S::Plain::constant(0.5)).sin_cos();
        let chord = sin_half + sin_half;
        let sunk = chord * (self.sin_entry * cos_half - self.cos_entry * sin_half);
        let behind = chord * (self.cos_entry * cos_half + self.sin_entry * sin_half);
        RimPoint { from_entry_rad, sin: self.sin_entry - behind, cos: self.cos_entry + sunk, sunk, behind }
    }
}
