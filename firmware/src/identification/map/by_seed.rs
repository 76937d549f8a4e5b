//! The readings by the seed's equations alone.

use crate::dual::Dual;
use crate::scalar::Scalar;
use crate::terramechanics::{Soil, wheel_forces};

use super::prediction::{Asked, COLUMNS, LATENTS, Model, Prediction};
use super::unknowns::{C1, C2, EXPONENT, STIFFNESS};

/// Equations 1–11. Only c₁ + c₂ i counts: one variable instead of two.
pub(super) struct BySeed;

impl<S: Scalar> Model<S> for BySeed {
    fn read(&self, at: &Asked<'_, S>) -> Option<Prediction<S>> {
        const VARIABLES: usize = 8;
        const PEAK: usize = 4;
        // Where each unknown stands among the variables, from the sinkage exponent on.
        const PLACES: [usize; 7] = [2, 3, PEAK, PEAK, 5, 6, 7];
        type Number<S> = Dual<S, VARIABLES>;
        let Asked { wheel, unknowns, point, latents, .. } = *at;
        let values = unknowns.values(point, |place, value| match place {
            C1 | C2 => Number::fixed(value),
            _ => PLACES.get(place.wrapping_sub(EXPONENT)).map_or(Number::fixed(value), |k| Number::variable(value, *k)),
        });
        let mut soil: Soil<Number<S>> = unknowns.soil(&values, Number::fixed);
        let peak = soil.peak_stress_c1.value + soil.peak_stress_c2.value * latents.slip;
        let by_slip = soil.peak_stress_c2.value;
        soil.peak_stress_c1 = Number::variable(peak, PEAK);
        soil.peak_stress_c2 = Number::fixed(S::zero());
        let (slip, sinkage_m) = (Number::variable(latents.slip, 1), Number::variable(latents.ln_sinkage, 0).exp());
        let forces = wheel_forces(&wheel.map(Number::fixed), &soil, slip, sinkage_m).ok()?;
        let readings = [forces.drawbar_pull_n, forces.load_n, forces.torque_nm, slip, sinkage_m];
        let slopes = readings.map(|reading| {
            let [by_ln_sinkage, direct, by_exponent, by_stiffness, by_peak, by_modulus, by_friction, by_cohesion] =
                reading.slopes;
            let mut slopes = [S::zero(); COLUMNS];
            let of_soil =
                [by_exponent, by_stiffness, by_peak, by_peak * latents.slip, by_modulus, by_friction, by_cohesion];
            for (slot, slope) in slopes.iter_mut().zip([by_ln_sinkage, direct + by_peak * by_slip]) {
                *slot = slope;
            }
            for (slot, slope) in slopes.iter_mut().skip(LATENTS + EXPONENT).zip(of_soil) {
                *slot = slope;
            }
            slopes
        });
        let [load_by_ln_sinkage, ..] = forces.load_n.slopes;
        Some(Prediction { readings: readings.map(|reading| reading.value), slopes, load_by_ln_sinkage })
    }
}

/// The stiffness's coordinate is the last of the pressure law's.
const _: () = assert!(STIFFNESS == EXPONENT + 1 && C1 == STIFFNESS + 1 && C2 == C1 + 1);
