//! Ways to look at a soil, for the maximum a posteriori.

use kapvik_firmware::identification::map::{MapEstimate, identify};
use kapvik_firmware::identification::{Observation, SoilPrior};
use kapvik_firmware::terramechanics::effects::{Conditions, Effects, Grousers};
use kapvik_firmware::terramechanics::{Quadrature, Soil, Wheel, WheelOnSoil};
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use super::made::{NOISE, SIX_SLIPS, kapvik_wheel, table_1_sand};

pub const WHEEL: Wheel<f64> = kapvik_wheel();
/// Table 1 of the seed.
pub const TABLE_1: Soil<f64> = table_1_sand();

/// A way to look at a soil: slips, half the spread of the loads about 65.4 N, and how many instants are averaged.
#[derive(Clone, Copy)]
pub struct Design<'a> {
    pub slips: &'a [f64],
    pub spread: f64,
    pub instants: f64,
    pub sinkage_seen: bool,
}

impl Design<'_> {
    pub const ONE_INSTANT: Self = Self { slips: &SIX_SLIPS, spread: 0.08, instants: 1.0, sinkage_seen: true };
    pub const MEAN_OF_100: Self = Self { instants: 100.0, ..Self::ONE_INSTANT };

    pub fn noise(&self) -> WheelNoise<f64> {
        NOISE.map(|std| std / self.instants.sqrt())
    }

    /// What is seen, `blur` standard deviations off; none where the soil carries a wheel deeper than 0.6 r.
    pub fn observe(
        &self,
        soil: &Soil<f64>,
        effects: &Effects<f64>,
        seed: u64,
        blur: f64,
    ) -> Option<Vec<Observation<f64>>> {
        let (mut random, noise) = (ChaCha8Rng::seed_from_u64(seed), self.noise());
        let on_soil = WheelOnSoil {
            wheel: &WHEEL,
            grousers: &Grousers::none(),
            soil,
            effects,
            gravity_m_s2: 9.81,
            quadrature: Quadrature::REFERENCE,
        };
        let mut seen = Vec::new();
        for &slip in self.slips {
            let load_n = 65.4 * (1.0 + self.spread * (2.0 * random.random::<f64>() - 1.0));
            let truth = on_soil.at_load(&Conditions::default(), slip, load_n).ok()?;
            if truth.sinkage_m > 0.6 * WHEEL.radius_m {
                return None;
            }
            let normal = || -> f64 { StandardNormal.sample(&mut random) };
            let state = WheelState::from(truth).blurred(&noise.map(|std| blur * std), normal);
            let state = WheelState { sinkage_m: state.sinkage_m.filter(|_| self.sinkage_seen), ..state };
            seen.push(Observation { state, noise });
        }
        Some(seen)
    }

    pub fn estimates(&self, soil: &Soil<f64>, count: u64) -> Vec<MapEstimate<f64>> {
        let estimate = |seed| {
            let seen = self.observe(soil, &Effects::none(), seed, 1.0).expect("the soil carries the wheels");
            identify(&WHEEL, &seen, &SoilPrior::usual()).expect("an estimate")
        };
        (0..count).into_par_iter().map(estimate).collect()
    }
}
