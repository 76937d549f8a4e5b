//! How well a soil explains a drawbar pull and a torque.

use crate::dual::Dual;
use crate::scalar::Scalar;
use crate::terramechanics::{Soil, Wheel, WheelForces, sinkage_for_load, wheel_forces};

use super::super::Observation;

/// How well a soil explains some observations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Likelihood<S> {
    /// Its logarithm, but for a constant that all soils share.
    pub ln: S,
    /// χ²: the squares of what is left, over their variance; two for each observation if the soil is the right one.
    pub chi_square: S,
}

/// A drawbar pull (N) and a torque (N·m), or how they change.
#[derive(Debug, Clone, Copy)]
struct Pair<S> {
    drawbar_pull_n: S,
    torque_nm: S,
}

/// What a soil says of a wheel at a measured slip and load.
struct Prediction<S> {
    /// The drawbar pull and the torque.
    expected: Pair<S>,
    /// Their change with slip, at the same load.
    by_slip: Pair<S>,
    /// Their change with load, at the same slip, per N.
    by_load: Pair<S>,
}

impl<S: Scalar> Likelihood<S> {
    /// Of a soil, given all of the observations; none where it does not carry every wheel, nor where its logarithm falls below `least`: each
    /// observation takes from it (ln |Σ| ≥ 0 in units of the sensors' noise), so the others need not be asked.
    pub fn of(soil: &Soil<S>, wheel: &Wheel<S>, observations: &[Observation<S>], least: Option<S>) -> Option<Self> {
        let mut sum = Self { ln: S::zero(), chi_square: S::zero() };
        for observation in observations {
            let one = Prediction::of(soil, wheel, observation)?.likelihood(observation)?;
            sum = Self { ln: sum.ln + one.ln, chi_square: sum.chi_square + one.chi_square };
            if least.is_some_and(|least| sum.ln < least) {
                return None;
            }
        }
        Some(sum)
    }
}

impl<S: Scalar> Prediction<S> {
    /// At the sinkage at which the soil carries the load.
    ///
    /// Slip and load move the sinkage, and it the forces: with derivatives by slip and sinkage, dz = (dW − W_s ds)/W_z.
    fn of(soil: &Soil<S>, wheel: &Wheel<S>, observation: &Observation<S>) -> Option<Self> {
        let state = &observation.state;
        let sinkage_m = sinkage_for_load(wheel, soil, state.slip, state.load_n).ok()?;
        let (slip, sinkage) = (Dual::<S, 2>::variable(state.slip, 0), Dual::variable(sinkage_m, 1));
        let forces = wheel_forces(&wheel.map(Dual::fixed), &soil.map(Dual::fixed), slip, sinkage).ok()?;
        let WheelForces { drawbar_pull_n, load_n, torque_nm } = forces;
        let [load_by_slip, load_by_sinkage] = load_n.slopes;
        let by_slip = |[by_slip, by_sinkage]: [S; 2]| by_slip - by_sinkage * load_by_slip / load_by_sinkage;
        let by_load = |[_, by_sinkage]: [S; 2]| by_sinkage / load_by_sinkage;
        let pair = |of: &dyn Fn([S; 2]) -> S| Pair {
            drawbar_pull_n: of(drawbar_pull_n.slopes),
            torque_nm: of(torque_nm.slopes),
        };
        Some(Self {
            expected: Pair { drawbar_pull_n: drawbar_pull_n.value, torque_nm: torque_nm.value },
            by_slip: pair(&by_slip),
            by_load: pair(&by_load),
        })
    }

    /// The normal density of what was measured, its covariance the sensors' and what slip and load noise make of the
    /// prediction; none where that covariance is not positive.
    fn likelihood(&self, observation: &Observation<S>) -> Option<Likelihood<S>> {
        let (state, noise) = (&observation.state, &observation.noise);
        let (slip, load) = (self.by_slip.scaled(noise.slip), self.by_load.scaled(noise.load_n));
        // In units of the sensors' own noise the covariance is the unit matrix and the two outer products.
        let (slip, load) = (slip.over(observation), load.over(observation));
        let left = Pair {
            drawbar_pull_n: state.drawbar_pull_n - self.expected.drawbar_pull_n,
            torque_nm: state.torque_nm - self.expected.torque_nm,
        }
        .over(observation);
        let pulls = S::one() + slip.drawbar_pull_n * slip.drawbar_pull_n + load.drawbar_pull_n * load.drawbar_pull_n;
        let torques = S::one() + slip.torque_nm * slip.torque_nm + load.torque_nm * load.torque_nm;
        let both = slip.drawbar_pull_n * slip.torque_nm + load.drawbar_pull_n * load.torque_nm;
        let determinant = pulls * torques - both * both;
        let (pull, torque) = (left.drawbar_pull_n, left.torque_nm);
        let two = S::constant(2.0);
        let chi_square = (torques * pull * pull - two * both * pull * torque + pulls * torque * torque) / determinant;
        let ln = S::constant(-0.5) * (chi_square + determinant.ln());
        (determinant > S::zero() && ln.is_finite()).then_some(Likelihood { ln, chi_square })
    }
}

impl<S: Scalar> Pair<S> {
    fn scaled(self, factor: S) -> Self {
        Self { drawbar_pull_n: self.drawbar_pull_n * factor, torque_nm: self.torque_nm * factor }
    }

    /// In standard deviations of the sensors.
    fn over(self, observation: &Observation<S>) -> Self {
        let noise = &observation.noise;
        Self { drawbar_pull_n: self.drawbar_pull_n / noise.drawbar_pull_n, torque_nm: self.torque_nm / noise.torque_nm }
    }
}
