//! The readings with the effects that are declared.

use crate::dual::Dual;
use crate::scalar::Scalar;
use crate::terramechanics::{Memory, Quadrature, Soil, WheelOnSoil};

use super::DeclaredEffects;
use super::prediction::{Asked, COLUMNS, LATENTS, Model, Prediction};

impl<S: Scalar> Model<S> for DeclaredEffects<S> {
    fn read(&self, at: &Asked<'_, S>) -> Option<Prediction<S>> {
        type Number<S> = Dual<S, COLUMNS>;
        let Asked { wheel, unknowns, conditions, load_n, point, latents } = *at;
        let values = unknowns.values(point, |place, value| Number::variable(value, LATENTS + place));
        let soil: Soil<Number<S>> = unknowns.soil(&values, Number::fixed);
        let mut effects = self.effects.map(Number::fixed);
        for (free, value) in self.free.iter().zip(values) {
            effects.set(free.effect, free.parameter, value);
        }
        let wheel = wheel.map(Number::fixed);
        let grousers = self.grousers.map(Number::fixed);
        let on_soil = WheelOnSoil {
            wheel: &wheel,
            grousers: &grousers,
            soil: &soil,
            effects: &effects,
            gravity_m_s2: Number::fixed(self.gravity_m_s2),
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
