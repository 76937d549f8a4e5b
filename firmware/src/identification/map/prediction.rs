//! What the sensors of a wheel should read, and how that changes with every unknown.

use crate::dual::Dual;
use crate::scalar::Scalar;
use crate::terramechanics::effects::Conditions;
use crate::terramechanics::{Memory, Quadrature, Soil, Wheel, WheelOnSoil, wheel_forces};

use super::DeclaredEffects;
use super::unknowns::{C1, C2, EXPONENT, Point, STIFFNESS, UNKNOWNS, Unknowns};

/// What is unknown of one observation.
pub(super) const LATENTS: usize = 2;
/// Columns of the slopes: ln z, slip, then the unknowns that are shared.
pub(super) const COLUMNS: usize = LATENTS + UNKNOWNS;
/// Channels: drawbar pull, load, torque, slip, sinkage.
pub(super) const CHANNELS: usize = 5;

/// The true sinkage and slip of an observation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Latents<S> {
    /// ln z, z in m.
    pub ln_sinkage: S,
    /// Slip, −1 … 1.
    pub slip: S,
}

/// Readings of drawbar pull, load, torque, slip and sinkage.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prediction<S> {
    /// The readings, in their units.
    pub readings: [S; CHANNELS],
    /// Their changes with ln z, the slip, and the coordinates of the unknowns.
    pub slopes: [[S; COLUMNS]; CHANNELS],
    /// Change of the true load with ln z, N.
    pub load_by_ln_sinkage: S,
}

/// A wheel on a soil as a function of the unknowns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forward<'a, S> {
    pub wheel: &'a Wheel<S>,
    pub unknowns: &'a Unknowns<S>,
    pub declared: &'a DeclaredEffects<S>,
}

impl<S: Scalar> Forward<'_, S> {
    /// The readings at a point; none where the equations do not hold.
    pub fn predict(
        &self,
        conditions: &Conditions<S>,
        load_n: S,
        point: &Point<S>,
        latents: &Latents<S>,
    ) -> Option<Prediction<S>> {
        let mut prediction = if self.declared.is_none() {
            self.by_seed(point, latents)
        } else {
            self.with_effects(conditions, load_n, point, latents)
        }?;
        for slopes in &mut prediction.slopes {
            for (place, slope) in slopes.iter_mut().skip(LATENTS).enumerate() {
                *slope = *slope * self.unknowns.slope(place, point);
            }
        }
        let finite = prediction.readings.iter().chain(prediction.slopes.iter().flatten()).all(|n| n.is_finite());
        finite.then_some(prediction)
    }

    /// Equations 1–11. Only c₁ + c₂ i counts: one variable instead of two.
    fn by_seed(&self, point: &Point<S>, latents: &Latents<S>) -> Option<Prediction<S>> {
        const VARIABLES: usize = 8;
        const PEAK: usize = 4;
        // Where each unknown stands among the variables, from the sinkage exponent on.
        const PLACES: [usize; 7] = [2, 3, PEAK, PEAK, 5, 6, 7];
        type Number<S> = Dual<S, VARIABLES>;
        let values = self.unknowns.values(point, |place, value| match place {
            C1 | C2 => Number::fixed(value),
            _ => PLACES.get(place.wrapping_sub(EXPONENT)).map_or(Number::fixed(value), |k| Number::variable(value, *k)),
        });
        let mut soil: Soil<Number<S>> = self.unknowns.soil(&values, Number::fixed);
        let peak = soil.peak_stress_c1.value + soil.peak_stress_c2.value * latents.slip;
        let by_slip = soil.peak_stress_c2.value;
        soil.peak_stress_c1 = Number::variable(peak, PEAK);
        soil.peak_stress_c2 = Number::fixed(S::zero());
        let (slip, sinkage_m) = (Number::variable(latents.slip, 1), Number::variable(latents.ln_sinkage, 0).exp());
        let forces = wheel_forces(&self.wheel.map(Number::fixed), &soil, slip, sinkage_m).ok()?;
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

    /// The same with the declared effects.
    fn with_effects(
        &self,
        conditions: &Conditions<S>,
        load_n: S,
        point: &Point<S>,
        latents: &Latents<S>,
    ) -> Option<Prediction<S>> {
        type Number<S> = Dual<S, COLUMNS>;
        let values = self.unknowns.values(point, |place, value| Number::variable(value, LATENTS + place));
        let soil: Soil<Number<S>> = self.unknowns.soil(&values, Number::fixed);
        let mut effects = self.declared.effects.map(Number::fixed);
        for (free, value) in self.declared.free.iter().zip(values) {
            effects.set(free.effect, free.parameter, value);
        }
        let wheel = self.wheel.map(Number::fixed);
        let grousers = self.declared.grousers.map(Number::fixed);
        let on_soil = WheelOnSoil {
            wheel: &wheel,
            grousers: &grousers,
            soil: &soil,
            effects: &effects,
            gravity_m_s2: Number::fixed(self.declared.gravity_m_s2),
            quadrature: Quadrature::for_scalar::<S>(),
        };
        let conditions = conditions.map(Number::fixed);
        let (slip, sinkage_m) = (Number::variable(latents.slip, 1), Number::variable(latents.ln_sinkage, 0).exp());
        let truth = on_soil.forces(&conditions, slip, Number::fixed(load_n), sinkage_m).ok()?;
        let read = on_soil.readings(&conditions, &truth, &mut Memory::start());
        let readings = [read.drawbar_pull_n, read.load_n, read.torque_nm, read.slip, read.sinkage_m];
        let [load_by_ln_sinkage, ..] = truth.load_n.slopes;
        Some(Prediction {
            readings: readings.map(|reading| reading.value),
            slopes: readings.map(|reading| reading.slopes),
            load_by_ln_sinkage,
        })
    }
}

/// The stiffness's coordinate is the last of the pressure law's.
const _: () = assert!(STIFFNESS == EXPONENT + 1 && C1 == STIFFNESS + 1 && C2 == C1 + 1);
