//! A campaign's declared model, with more effects where they are tried: what it predicts of each row, and how that changes with
//! every parameter.

use kapvik_firmware::dual::Dual;
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::effects::{CATALOGUE, Effects, Grousers};
use kapvik_firmware::terramechanics::{Soil, Wheel};

use crate::data::campaign::Campaign;

use super::fit::{CHANNELS, Coordinate, Latent, Model, Prediction};
use super::measurements::Measurements;
use super::sensor_law::SensorLaw;
use super::site::{Bare, Carried, SLOTS, Site, Sloped};
use super::soil_coordinates::{SoilParameter, Treatment, treatments};
use super::specification::{EffectForm, Specification};

/// Derivatives of the largest model that there can be: all of the soil free, and every parameter of every effect.
const MOST: usize = SoilParameter::ALL.len() + most_effect_parameters() + SLOTS;

/// Parameters of all effects together.
const fn most_effect_parameters() -> usize {
    let (mut sum, mut place) = (0, 0);
    while place < CATALOGUE.len() {
        sum += CATALOGUE[place].parameters.len();
        place += 1;
    }
    sum
}

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
    /// What sensors make of what the wheel does, beyond the effects.
    sensors: Vec<SensorLaw>,
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
        let effects_free: Vec<_> = free.iter().map(|free| (free.id, free.parameter)).collect();
        let of_sensor = |effect: &EffectForm| {
            let place = effects_free.iter().position(|(id, _)| *id == effect.info.id)?;
            SensorLaw::of(effect, measurements, soil_free.len() + place)
        };
        let sensors = specification.effects.iter().filter_map(of_sensor).collect();
        coordinates.extend(free.into_iter().map(|free| free.coordinate));
        Self {
            measurements,
            wheel: campaign.wheel,
            grousers: campaign.grousers.of_library(),
            gravity_m_s2: campaign.gravity_m_s2,
            soil,
            soil_free,
            effects,
            effects_free,
            sensors,
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

    /// Wheel, soil and effects at some parameters.
    fn site(&self, parameters: &[f64]) -> Site<f64> {
        let mut site = Site {
            wheel: self.wheel,
            grousers: self.grousers,
            soil: self.soil(parameters),
            effects: self.effects,
            gravity_m_s2: self.gravity_m_s2,
        };
        for ((id, name), &value) in self.effects_free.iter().zip(&parameters[self.soil_free.len()..]) {
            site.effects.set(id, name, value);
        }
        site
    }

    /// Gives the site at some parameters its derivatives by all of them. In place, for with those it is large.
    fn slope<const N: usize>(&self, site: &mut Site<Dual<f64, N>>, parameters: &[f64]) {
        for (slot, (parameter, &value)) in self.soil_free.iter().zip(parameters).enumerate() {
            *parameter.place(&mut site.soil) = parameter.value(Dual::variable(value, slot));
        }
        for (slot, (id, name)) in (self.soil_free.len()..).zip(&self.effects_free) {
            site.effects.set(id, name, Dual::variable(parameters[slot], slot));
        }
    }

    fn run<const N: usize>(
        &self,
        parameters: &[f64],
        rows: &[usize],
        latents: &mut [Latent],
    ) -> Option<Vec<Prediction>> {
        let plain = self.site(parameters);
        let mut by_all = plain.map(Dual::constant);
        self.slope(&mut by_all, parameters);
        let sloped = Sloped::<N>::new(plain, &by_all, parameters.len());
        let mut carried = Carried::start();
        let predict = |(row, latent): (&usize, &mut Latent)| {
            sloped.predict(&self.measurements.conditions[*row], latent, &mut carried)
        };
        let mut predictions: Vec<Prediction> = rows.iter().zip(latents).map(predict).collect::<Option<_>>()?;
        self.sensors.iter().for_each(|sensor| sensor.read(parameters, &mut predictions));
        Some(predictions)
    }
}

impl Model for CampaignModel<'_> {
    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn predict(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<Prediction>> {
        // As few derivatives as there are, for each is carried through every operation; and up to 15 of them beside the value
        // are copied in place.
        match parameters.len() + SLOTS {
            0..=10 => self.run::<10>(parameters, rows, latents),
            11..=12 => self.run::<12>(parameters, rows, latents),
            13..=14 => self.run::<14>(parameters, rows, latents),
            15 => self.run::<15>(parameters, rows, latents),
            16..=22 => self.run::<22>(parameters, rows, latents),
            23..=40 => self.run::<40>(parameters, rows, latents),
            _ => self.run::<MOST>(parameters, rows, latents),
        }
    }

    fn values(&self, parameters: &[f64], rows: &[usize], latents: &mut [Latent]) -> Option<Vec<[f64; CHANNELS]>> {
        let bare = Bare::new(self.site(parameters));
        let mut carried = Carried::start();
        let values = |(row, latent): (&usize, &mut Latent)| {
            bare.values(&self.measurements.conditions[*row], latent, &mut carried)
        };
        let mut values: Vec<_> = rows.iter().zip(latents).map(values).collect::<Option<_>>()?;
        self.sensors.iter().for_each(|sensor| sensor.read_values(parameters, &mut values));
        Some(values)
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

#[cfg(test)]
mod tests {
    use kapvik_firmware::terramechanics::effects::{ParameterInfo, effect_info};

    use super::*;
    use crate::data::campaign::{Carried as Campaigns, Knowledge};
    use crate::diagnose::fit::Start;

    /// The last step to the sinkage takes its slope, which is summed in another order where there are more of them.
    fn check_rounding(one: f64, other: f64) {
        assert!((one - other).abs() <= 1e-13 * one.abs(), "{one}, {other}");
    }

    /// A step that is judged by its values and then taken must lead to the place that was judged: the same bits, also of an
    /// effect with memory, whether they come with slopes or without, and from near or from far.
    #[test]
    fn a_model_may_have_every_effect_there_is() {
        let campaign = Campaigns::from_name("cmu-smooth-transients").expect("carried").campaign().expect("a campaign");
        let measurements = Measurements::of(&campaign, false).expect("measured");
        let mut specification = Specification::default();
        for info in CATALOGUE {
            // Whatever a file gives bounds to is free, whichever form the effect has.
            let between = |parameter: &ParameterInfo| {
                let width = 1e-3 * (parameter.high - parameter.low);
                let (min, max) = (parameter.low.max(parameter.neutral - width), parameter.neutral + width);
                (parameter.name, Knowledge::Between { min, max })
            };
            let known = info.parameters.iter().map(between).collect();
            specification = specification.with(EffectForm { known, ..EffectForm::new(info, &info.forms[0]) });
            let model = CampaignModel::new(&campaign, &measurements, &specification);
            let start = Start::of(&model, &measurements.rows);
            let run = &measurements.rows_of_run[0];
            let mut latents: Vec<Latent> = run.iter().map(|row| start.latents[*row]).collect();
            let predictions = model.predict(&start.parameters, run, &mut latents).expect("predictions");
            let slopes = predictions.iter().map(|prediction| prediction.slopes.by_parameter.len());
            assert!(slopes.into_iter().all(|count| count == start.parameters.len()), "{}", info.id);
        }
    }

    #[test]
    fn values_are_the_same_with_slopes_and_without() {
        let campaign = Campaigns::from_name("cmu-smooth-transients").expect("carried").campaign().expect("a campaign");
        let measurements = Measurements::of(&campaign, false).expect("measured");
        let info = effect_info("sinkage-lag").expect("listed");
        let specification = Specification::default().with(EffectForm::new(info, &info.forms[0]));
        let model = CampaignModel::new(&campaign, &measurements, &specification);
        let start = Start::of(&model, &measurements.rows);
        for (run, factor) in measurements.rows_of_run.iter().zip([1.0, 0.3, 3.0].into_iter().cycle()) {
            let far = |row: &usize| Latent { sinkage_m: factor * start.latents[*row].sinkage_m, ..start.latents[*row] };
            let mut latents: Vec<Latent> = run.iter().map(far).collect();
            let mut others = latents.clone();
            let values = model.values(&start.parameters, run, &mut latents).expect("values");
            for latents in [&mut latents, &mut others] {
                let predictions = model.predict(&start.parameters, run, latents).expect("predictions");
                for (prediction, value) in predictions.iter().zip(&values) {
                    prediction.value.iter().zip(value).for_each(|(with, without)| check_rounding(*with, *without));
                }
            }
            for (near, far) in latents.iter().zip(&others) {
                check_rounding(near.sinkage_m, far.sinkage_m);
                assert_eq!((near.slip, near.load_n), (far.slip, far.load_n));
            }
        }
    }
}
