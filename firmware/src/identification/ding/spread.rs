//! What of the third step's least singular value is noise.

use crate::identification::least_squares::Triangle;
use crate::scalar::Scalar;

use super::rows::{Sensitive, Traced};

/// How far the normal stresses at the peak differ among the observations: one standard deviation, each observation weighted
/// by how far its shear is mobilised.
///
/// Under equal normal stresses c and tan φ have the same column, and the least singular value of the two is zero. Noisy
/// stresses are never equal; what noise alone would make of equal ones is the measure of what the spread is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressSpread<S> {
    /// Seen, Pa.
    pub seen_pa: S,
    /// To be expected of the noise alone, Pa.
    pub noise_pa: S,
}

impl<S: Scalar> StressSpread<S> {
    /// The spread of the rows whose equations are `line`.
    pub(super) fn new(rows: &Sensitive<'_, S>, line: &Triangle<S, 2>, shear_modulus_m: S) -> Self {
        let length = line.length(0);
        let modulus_m = Traced::fixed(shear_modulus_m);
        let mut noise = S::zero();
        for row in rows.iter() {
            let mobilised = row.stress.mobilised(modulus_m).value;
            let share = mobilised * mobilised / (length * length);
            // Less what moves the mean along.
            noise += share * (S::one() - share) * row.variance(&row.stress.normal_pa);
        }
        Self { seen_pa: line.pivot(1) / length, noise_pa: noise.sqrt() }
    }

    /// Whether more is seen than is to be expected of the noise alone.
    pub fn is_told(&self) -> bool {
        self.seen_pa > self.noise_pa
    }
}
