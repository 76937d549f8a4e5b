//! Step 3: cohesion, friction and shear modulus, from the shear stress at the peak.

use crate::identification::StressShape;
use crate::identification::least_squares::Triangle;
use crate::scalar::Scalar;

use super::DingBounds;
use super::rows::Rows;

/// τm = (c + σm tan φ)(1 − e^(−j/K)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strength<S> {
    /// c, Pa.
    pub cohesion_pa: S,
    /// tan φ.
    pub tan_friction: S,
    /// K, m.
    pub shear_modulus_m: S,
}

impl<S: Scalar> Strength<S> {
    /// Whether all are numbers.
    pub fn is_finite(&self) -> bool {
        [self.cohesion_pa, self.tan_friction, self.shear_modulus_m].iter().all(|number| number.is_finite())
    }
}

/// The equations τm = c e + tan φ (e σm) at a K, e = 1 − e^(−j/K).
pub(super) fn line<S: Scalar>(rows: &Rows<'_, S>, shape: &StressShape<S>, shear_modulus_m: S) -> Triangle<S, 2> {
    let mut line = Triangle::new();
    for stress in rows.stresses(shape) {
        let mobilised = stress.mobilised(shear_modulus_m);
        line.add([mobilised, mobilised * stress.normal_pa], stress.shear_pa);
    }
    line
}

/// Variable projection: the best of a grid of K, even in its logarithm, refined by golden sections between its neighbours.
pub(super) fn fit<S: Scalar>(rows: &Rows<'_, S>, shape: &StressShape<S>, bounds: &DingBounds<S>) -> Strength<S> {
    const GRID: u8 = 32;
    const SECTIONS: usize = 20;
    let at = |ln_k: S| Candidate::new(rows, shape, bounds, ln_k);
    let (lowest, highest) = (bounds.shear_modulus_m.low.ln(), bounds.shear_modulus_m.high.ln());
    let step = (highest - lowest) / S::constant(f64::from(GRID));
    let grid = (1..=GRID).map(|place| lowest + step * S::constant(f64::from(place)));
    let mut best = grid.map(at).fold(at(lowest), Candidate::better);

    let (mut low, mut high) = ((best.ln_k - step).max(lowest), (best.ln_k + step).min(highest));
    let golden = S::constant(0.618_033_988_749_894_9);
    for _ in 0..SECTIONS {
        let (left, right) = (at(high - golden * (high - low)), at(low + golden * (high - low)));
        if left.cost < right.cost {
            high = right.ln_k;
        } else {
            low = left.ln_k;
        }
        best = best.better(left).better(right);
    }
    best.strength
}

/// The best strength at a K.
#[derive(Debug, Clone, Copy)]
struct Candidate<S> {
    ln_k: S,
    strength: Strength<S>,
    cost: S,
}

impl<S: Scalar> Candidate<S> {
    fn new(rows: &Rows<'_, S>, shape: &StressShape<S>, bounds: &DingBounds<S>, ln_k: S) -> Self {
        let shear_modulus_m = ln_k.exp();
        let line = line(rows, shape, shear_modulus_m);
        let [cohesion_pa, tan_friction] = line.solution_within([bounds.cohesion_pa, bounds.tan_friction]);
        let cost = line.cost([cohesion_pa, tan_friction]);
        Self { ln_k, strength: Strength { cohesion_pa, tan_friction, shear_modulus_m }, cost }
    }

    fn better(self, other: Self) -> Self {
        if other.cost < self.cost { other } else { self }
    }
}
