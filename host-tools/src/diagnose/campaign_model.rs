//! A campaign's declared model, with more effects where they are tried: what it predicts of each row, and how that changes with
//! every parameter.

use kapvik_firmware::dual::Dual;
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::effects::{Conditions, Effects, Grousers};
use kapvik_firmware::terramechanics::{Memory, Quadrature, Readings, Soil, Wheel, WheelOnSoil, WheelTruth};

use crate::data::campaign::Campaign;

use super::fit::{CHANNELS, Coordinate, Latent, Model, Prediction};
use super::measurements::{Measurements, grousers};
use super::soil_coordinates::{SoilParameter, Treatment, treatments};
use super::specification::Specification;

/// Derivatives that are carried along beside those by the free parameters: by slip, load and sinkage.
const LATENTS: usize = 3;

/// The sinkage has been found once a step changes its logarithm by less; what is left is corrected to first order.
const NEAR: f64 = 1e-3;
/// Newton steps before the bracketed solve takes over.
const STEPS: usize = 12;
/// Sinkage over radius beyond which no load is looked for.
const BOTTOM: f64 = 0.9;

/// A model of the readings of a campaign.
#[derive(Debug, Clone)]
pub struct CampaignModel<'a> {
    measurements: &'a Measurements,
    wheel: Wheel<f64>,
    grousers: Grousers<f64>,
    gravity_m_s2: f64,
    soil: Soil<f64>,
    soil_free: Vec<SoilParameter>,
    effects: Effects<f64>,
    effects_free: Vec<(&'static str, &'static str)>,
    coordinates: Vec<Coordinate>,
}

impl<'a> CampaignModel<'a> {
    /// The model of a campaign's rows with some effects.
    pub fn new(campaign: &Campaign, measurements: &'a Measurements, specification: &Specification) -> Self {
        let mut soil = blank_soil();
        let (mut soil_free, mut coordinates) = (Vec::new(), Vec::new());
        for (parameter, treatment) in treatments(campaign) {
            match treatment {
                Treatment::Fixed(value) => *parameter.place(&mut soil) = value,
                Treatment::Free(coordinate) => {
                    soil_free.push(parameter);
                    coordinates.push(coordinate);
                }
            }
        }
        let (effects, free) = specification.effects(measurements);
        let effects_free = free.iter().map(|free| (free.id, free.parameter)).collect();
        coordinates.extend(free.into_iter().map(|free| free.coordinate));
        Self {
            measurements,
            wheel: campaign.wheel,
            grousers: grousers(campaign),
            gravity_m_s2: campaign.gravity_m_s2,
            soil,
            soil_free,
            effects,
            effects_free,
            coordinates,
        }
    }

    /// How many of the coordinates are the soil's; they come first.
    pub fn soil_count(&self) -> usize {
        self.soil_free.len()
    }

    /// The soil's free parameters, in the order of the coordinates.
    pub fn soil_parameters(&self) -> &[SoilParameter] {
        &self.soil_free
    }

    /// Id and name of the effects' free parameters, in the order of the coordinates behind the soil's.
    pub fn effect_parameters(&self) -> &[(&'static str, &'static str)] {
        &self.effects_free
    }

    /// The soil at some parameters, its stiffness all in k_φ.
    pub fn soil(&self, parameters: &[f64]) -> Soil<f64> {
        let mut soil = self.soil;
        for (parameter, value) in self.soil_free.iter().zip(parameters) {
            *parameter.place(&mut soil) = parameter.value(*value);
        }
        soil
    }

    fn run<const N: usize>(
        &self,
        parameters: &[f64],
        rows: &[usize],
        latents: &mut [Latent],
    ) -> Option<Vec<Prediction>> {
        let place = Place::<N>::new(self, parameters);
        let mut memory = Memory::start();
        let predict = |(row, latent): (&usize, &mut Latent)| {
            place.predict(&self.measurements.conditions[*row], latent, &mut memory)
        };
        rows.iter().zip(latents).map(predict).collect()
    }
}

impl Model for CampaignModel<'_> {
    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        // As few derivatives as there are, for each is carried through every operation; and up to 15 of them beside the value
        // are copied in place.
        match parameters.len() + LATENTS {
            0..=10 => self.run::<10>(parameters, rows, latents),
            11..=12 => self.run::<12>(parameters, rows, latents),
            13..=14 => self.run::<14>(parameters, rows, latents),
            15 => self.run::<15>(parameters, rows, latents),
            _ => self.run::<22>(parameters, rows, latents),
        }
    }
}

/// The soil before any of its parameters is set.
fn blank_soil() -> Soil<f64> {
    Soil {
        sinkage_exponent: 1.0,
        cohesive_modulus: 0.0,
        frictional_modulus: 1e6,
        cohesion_pa: 0.0,
        friction_angle_rad: 0.0,
        shear_modulus_m: 0.0,
        peak_stress_c1: 0.0,
        peak_stress_c2: 0.0,
        rebound_ratio: 0.0,
    }
}

/// A wheel, its soil and its effects in one scalar.
struct Site<S> {
    wheel: Wheel<S>,
    grousers: Grousers<S>,
    soil: Soil<S>,
    effects: Effects<S>,
    gravity_m_s2: S,
}

impl<S: Scalar> Site<S> {
    fn on_soil(&self) -> WheelOnSoil<'_, S> {
        WheelOnSoil {
            wheel: &self.wheel,
            grousers: &self.grousers,
            soil: &self.soil,
            effects: &self.effects,
            gravity_m_s2: self.gravity_m_s2,
            quadrature: Quadrature::FLIGHT,
        }
    }

    fn map<T>(&self, convert: impl Fn(S) -> T + Copy) -> Site<T> {
        Site {
            wheel: self.wheel.map(convert),
            grousers: self.grousers.map(convert),
            soil: self.soil.map(convert),
            effects: self.effects.map(convert),
            gravity_m_s2: convert(self.gravity_m_s2),
        }
    }
}

/// The model at a place of its parameters: plainly, with the derivative by the sinkage, and with all derivatives.
struct Place<const N: usize> {
    plain: Site<f64>,
    by_sinkage: Site<Dual<f64, 1>>,
    by_all: Site<Dual<f64, N>>,
    count: usize,
}

impl<const N: usize> Place<N> {
    fn new(model: &CampaignModel<'_>, parameters: &[f64]) -> Self {
        let mut plain = Site {
            wheel: model.wheel,
            grousers: model.grousers,
            soil: model.soil(parameters),
            effects: model.effects,
            gravity_m_s2: model.gravity_m_s2,
        };
        let mut by_all = plain.map(Dual::constant);
        for (slot, (parameter, &value)) in model.soil_free.iter().zip(parameters).enumerate() {
            *parameter.place(&mut by_all.soil) = parameter.value(Dual::variable(value, slot));
        }
        for (offset, (id, name)) in model.effects_free.iter().enumerate() {
            let slot = model.soil_free.len() + offset;
            plain.effects.set(id, name, parameters[slot]);
            by_all.effects.set(id, name, Dual::variable(parameters[slot], slot));
        }
        Self { by_sinkage: plain.map(Dual::constant), plain, by_all, count: parameters.len() }
    }

    const SLIP: usize = N - 3;
    const LOAD: usize = N - 2;
    const SINKAGE: usize = N - 1;

    fn predict(
        &self,
        conditions: &Conditions<f64>,
        latent: &mut Latent,
        memory: &mut Memory<Dual<f64, N>>,
    ) -> Option<Prediction> {
        let guess_m = self.sinkage(conditions, latent)?;
        let conditions = conditions.map(Dual::constant);
        let (truth, sinkage_m) = self.truth(&conditions, latent, guess_m)?;
        latent.sinkage_m = sinkage_m;
        let readings = self.by_all.on_soil().readings(&conditions, &truth, memory);
        forget_latents::<N>(memory);
        Some(self.prediction(&readings))
    }

    /// The true state at a slip and a load, with its derivatives by parameters, slip and load; and the sinkage, of which
    /// there is a near guess.
    fn truth(
        &self,
        conditions: &Conditions<Dual<f64, N>>,
        latent: &Latent,
        guess_m: f64,
    ) -> Option<(WheelTruth<Dual<f64, N>>, f64)> {
        let slip = Dual::variable(latent.slip, Self::SLIP);
        let load_n = Dual::variable(latent.load_n, Self::LOAD);
        let sinkage = Dual::variable(guess_m, Self::SINKAGE);
        let found = self.by_all.on_soil().forces(conditions, slip, load_n, sinkage).ok()?;
        let by_sinkage = found.load_n.slopes[Self::SINKAGE];
        if by_sinkage.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        // Where the load is met, a change of anything moves the sinkage so that it stays met; and the sinkage that met it
        // nearly is moved the rest.
        let mut carried = found.load_n;
        carried.slopes[Self::SINKAGE] = 0.0;
        let missing = load_n - carried;
        let by_each: [f64; N] = std::array::from_fn(|slot| missing.slopes[slot] / by_sinkage);
        let step_m = missing.value / by_sinkage;
        let settle = |channel: Dual<f64, N>| {
            let by = channel.slopes[Self::SINKAGE];
            let mut settled = channel;
            settled.value += by * step_m;
            settled.slopes[Self::SINKAGE] = 0.0;
            for (slope, each) in settled.slopes.iter_mut().zip(&by_each) {
                *slope += by * each;
            }
            settled
        };
        let truth = WheelTruth {
            slip,
            load_n,
            drawbar_pull_n: settle(found.drawbar_pull_n),
            torque_nm: settle(found.torque_nm),
            sinkage_m: settle(sinkage),
            side_force_n: settle(found.side_force_n),
        };
        Some((truth, guess_m + step_m))
    }

    /// The sinkage at which the soil carries the load, nearly: Newton's method on ln W over ln z from the last one, else the
    /// bracketed solve.
    fn sinkage(&self, conditions: &Conditions<f64>, latent: &Latent) -> Option<f64> {
        let on_soil = self.by_sinkage.on_soil();
        let conditions_here = conditions.map(Dual::constant);
        let (slip, load_n) = (Dual::constant(latent.slip), Dual::constant(latent.load_n));
        let bottom_m = BOTTOM * self.plain.wheel.radius_m;
        let mut sinkage_m = latent.sinkage_m.clamp(1e-4 * self.plain.wheel.radius_m, bottom_m);
        for _ in 0..STEPS {
            let found = on_soil.forces(&conditions_here, slip, load_n, Dual::variable(sinkage_m, 0)).ok()?.load_n;
            let by_ln_sinkage = found.slopes[0] * sinkage_m;
            if !(found.value > 0.0 && by_ln_sinkage > 0.0) {
                break;
            }
            let step = (latent.load_n / found.value).ln() * found.value / by_ln_sinkage;
            if step.abs() < NEAR {
                return Some(sinkage_m);
            }
            sinkage_m = (sinkage_m * step.clamp(-1.0, 1.0).exp()).min(bottom_m);
        }
        let plainly = self.plain.on_soil();
        plainly.at_load(conditions, latent.slip, latent.load_n).ok().map(|truth| truth.sinkage_m)
    }

    fn prediction(&self, readings: &Readings<Dual<f64, N>>) -> Prediction {
        let channels = in_order(readings);
        let by = |slot: usize| -> [f64; CHANNELS] { std::array::from_fn(|channel| channels[channel].slopes[slot]) };
        Prediction {
            value: channels.map(|channel| channel.value),
            by_parameter: (0..self.count).map(by).collect(),
            by_slip: by(Self::SLIP),
            by_load: by(Self::LOAD),
        }
    }
}

/// The readings in the order of [`super::fit::Reading::ALL`].
fn in_order<S: Copy>(readings: &Readings<S>) -> [S; CHANNELS] {
    [
        readings.drawbar_pull_n,
        readings.torque_nm,
        readings.sinkage_m,
        readings.side_force_n,
        readings.slip,
        readings.load_n,
    ]
}

/// Slip and load of a row are not those of the next: what the memory carries on depends on the parameters alone.
fn forget_latents<const N: usize>(memory: &mut Memory<Dual<f64, N>>) {
    if let Some((sinkage_m, _)) = &mut memory.lagging {
        sinkage_m.slopes[N - 3..].fill(0.0);
    }
}
