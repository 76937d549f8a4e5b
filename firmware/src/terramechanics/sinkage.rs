//! The sinkage at which the soil carries a given load.

use crate::scalar::Scalar;

use super::bracketing::{Bracket, solve};
use super::{ForceError, Soil, Wheel, wheel_forces};

/// Why no sinkage could be found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SinkageError {
    /// The load is not a number above zero, the slip is outside −1 … 1, the wheel or the soil is outside its range,
    /// or so extreme that a force overflows.
    Input,
    /// The soil does not carry the load at any sinkage up to [`deepest_sinkage`]; [`greatest_load`] says what it carries.
    LoadTooGreat,
}

/// What a soil carries at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GreatestLoad<S> {
    /// The load, N.
    pub load_n: S,
    /// The sinkage at which the soil carries it, m.
    pub sinkage_m: S,
}

/// The deepest sinkage that is looked at, m: 0.9 r. Deeper, the soil reaches the hub and the equations end.
pub fn deepest_sinkage<S: Scalar>(wheel: &Wheel<S>) -> S {
    S::constant(0.9) * wheel.radius_m
}

/// The smallest sinkage (m) at which a wheel at the given slip carries `load_n`, in 0 … [`deepest_sinkage`].
///
/// Load rises with sinkage when driving. When braking it rises to a peak and may fall again behind it (and is negative at
/// first where cohesion pulls the rim down): the sinkage is then the one on the rising side.
///
/// The load is met to 1e-11 of itself in double precision and 4e-6 in single, or as well as the scalar can.
/// Cost: about seven evaluations of [`wheel_forces`]; at most some three hundred, where the load is near the greatest.
///
/// # Errors
/// Where an input is outside its range, or the soil cannot carry the load.
pub fn sinkage_for_load<S: Scalar>(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, load_n: S) -> Result<S, SinkageError> {
    LoadCurve::new(wheel, soil, |sinkage_m| load_at(wheel, soil, slip, sinkage_m)).sinkage_for(load_n)
}

/// The greatest load that a soil carries up to [`deepest_sinkage`], and where. Cost: about eighty evaluations.
///
/// # Errors
/// Where an input is outside its range.
pub fn greatest_load<S: Scalar>(wheel: &Wheel<S>, soil: &Soil<S>, slip: S) -> Result<GreatestLoad<S>, SinkageError> {
    LoadCurve::new(wheel, soil, |sinkage_m| load_at(wheel, soil, slip, sinkage_m)).peak()
}

fn load_at<S: Scalar>(wheel: &Wheel<S>, soil: &Soil<S>, slip: S, sinkage_m: S) -> Result<S, ForceError> {
    wheel_forces(wheel, soil, slip, sinkage_m).map(|forces| forces.load_n)
}

/// Load over sinkage, at one slip.
pub(super) struct LoadCurve<'a, S, F> {
    wheel: &'a Wheel<S>,
    /// The soil, for a first guess.
    soil: &'a Soil<S>,
    /// The load at a sinkage, N.
    load_n: F,
    /// n + ½: load grows about as sinkage to this power.
    exponent: S,
}

impl<'a, S: Scalar, F: Fn(S) -> Result<S, ForceError>> LoadCurve<'a, S, F> {
    /// The curve `load_n` of a wheel on about that soil.
    pub fn new(wheel: &'a Wheel<S>, soil: &'a Soil<S>, load_n: F) -> Self {
        Self { wheel, soil, load_n, exponent: soil.sinkage_exponent + S::constant(0.5) }
    }

    /// The smallest sinkage that carries a load: see [`sinkage_for_load`].
    pub fn sinkage_for(&self, load_n: S) -> Result<S, SinkageError> {
        if !(load_n > S::zero() && load_n.is_finite()) {
            return Err(SinkageError::Input);
        }
        let bracket = self.bracket(load_n)?;
        let tolerance = if S::EPSILON > 1e-10 { S::constant(4e-6) } else { S::constant(1e-11) };
        solve(bracket, tolerance / self.exponent, |sinkage_m| self.excess(sinkage_m, load_n))
    }

    /// The load at a sinkage, N.
    fn at(&self, sinkage_m: S) -> Result<S, SinkageError> {
        (self.load_n)(sinkage_m).map_err(|_| SinkageError::Input)
    }

    /// (W/load)^(1/(n + ½)) − 1 with the sign of W: zero at the sinkage looked for, and nearly a straight line on the way.
    fn excess(&self, sinkage_m: S, load_n: S) -> Result<S, SinkageError> {
        let ratio = self.at(sinkage_m)? / load_n;
        let root = ratio.abs().powf(S::one() / self.exponent);
        Ok(if ratio < S::zero() { -root } else { root } - S::one())
    }

    /// Two sinkages between which the load is met first.
    fn bracket(&self, load_n: S) -> Result<Bracket<S>, SinkageError> {
        const STEPS: usize = 48;
        let deepest = deepest_sinkage(self.wheel);
        let mut low = (S::zero(), -S::one());
        let mut sinkage_m = self.guess(load_n).max(S::constant(1e-6) * deepest).min(deepest);
        let mut least_growth = S::constant(1.01);
        for _ in 0..STEPS {
            let excess = self.excess(sinkage_m, load_n)?;
            if excess >= S::zero() {
                return Ok(Bracket { low, high: (sinkage_m, excess) });
            }
            let past_peak = low.0 > S::zero() && excess < low.1;
            if past_peak || sinkage_m >= deepest {
                break;
            }
            low = (sinkage_m, excess);
            // On the straight line from the origin, and a little further, to end on the other side.
            let carried = S::one() + excess;
            let growth = S::constant(1.01) / carried.max(S::constant(0.5));
            sinkage_m = (sinkage_m * growth.max(least_growth)).min(deepest);
            least_growth = S::constant(1.5);
        }
        let peak = self.peak()?;
        if peak.load_n < load_n {
            return Err(SinkageError::LoadTooGreat);
        }
        Ok(Bracket { low: (S::zero(), -S::one()), high: (peak.sinkage_m, self.excess(peak.sinkage_m, load_n)?) })
    }

    /// Bekker's closed form for a rigid wheel without shear: W = b k √(2r) (1 − n/3) z^(n + ½).
    fn guess(&self, load_n: S) -> S {
        let exponent = self.soil.sinkage_exponent;
        let shape = (S::one() - exponent / S::constant(3.0)).max(S::constant(0.3));
        let stiffness = self.soil.stiffness(self.wheel.width_m) * self.wheel.width_m;
        let unit_load_n = stiffness * (S::constant(2.0) * self.wheel.radius_m).sqrt() * shape;
        (load_n / unit_load_n).abs().powf(S::one() / self.exponent)
    }

    /// The highest point of the curve: the best of a grid, refined by golden sections between its neighbours.
    fn peak(&self) -> Result<GreatestLoad<S>, SinkageError> {
        const GRID: u8 = 18;
        const SECTIONS: usize = 30;
        let step = deepest_sinkage(self.wheel) / S::constant(f64::from(GRID));
        let mut best =
            GreatestLoad { load_n: self.at(deepest_sinkage(self.wheel))?, sinkage_m: deepest_sinkage(self.wheel) };
        let mut sinkage_m = S::zero();
        for _ in 1..GRID {
            sinkage_m += step;
            best = best.greater(GreatestLoad { load_n: self.at(sinkage_m)?, sinkage_m });
        }
        let mut low = best.sinkage_m - step;
        let mut high = (best.sinkage_m + step).min(deepest_sinkage(self.wheel));
        let golden = S::constant(0.618_033_988_749_894_9);
        for _ in 0..SECTIONS {
            let (left_m, right_m) = (high - golden * (high - low), low + golden * (high - low));
            let left = GreatestLoad { load_n: self.at(left_m)?, sinkage_m: left_m };
            let right = GreatestLoad { load_n: self.at(right_m)?, sinkage_m: right_m };
            best = best.greater(left).greater(right);
            if left.load_n < right.load_n {
                low = left_m;
            } else {
                high = right_m;
            }
        }
        Ok(best)
    }
}

impl<S: Scalar> GreatestLoad<S> {
    fn greater(self, other: Self) -> Self {
        if other.load_n > self.load_n { other } else { self }
    }
}
