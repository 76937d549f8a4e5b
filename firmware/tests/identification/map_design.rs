//! Ways to look at a soil, for the maximum a posteriori.

use kapvik_firmware::identification::map::{MapEstimate, identify};
use kapvik_firmware::identification::{Belief, Observation, SoilPrior};
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

/// A truth from the usual beliefs.
pub fn drawn(seed: u64) -> Soil<f64> {
    let (mut random, prior) = (ChaCha8Rng::seed_from_u64(seed), SoilPrior::<f64>::usual());
    let mut draw = |belief: &Belief<f64>| loop {
        let normal: f64 = StandardNormal.sample(&mut random);
        let value = belief.mean + belief.spread() * normal;
        if value > belief.low && value < belief.high {
            return value;
        }
    };
    let exponent = draw(&prior.sinkage_exponent);
    let away = exponent - prior.sinkage_exponent.mean;
    Soil {
        sinkage_exponent: exponent,
        cohesive_modulus: 0.0,
        frictional_modulus: (draw(&prior.ln_stiffness) - away * prior.known_depth_m.ln()).exp(),
        cohesion_pa: draw(&prior.ln_cohesion).exp(),
        friction_angle_rad: draw(&prior.friction_angle_rad),
        shear_modulus_m: draw(&prior.ln_shear_modulus).exp(),
        peak_stress_c1: draw(&prior.peak_stress_c1),
        peak_stress_c2: draw(&prior.peak_stress_c2),
        rebound_ratio: 0.0,
    }
}

/// As if the torque had not been measured.
pub fn lose_torque(seen: &mut Observation<f64>) {
    (seen.state.torque_nm, seen.noise.torque_nm) = (0.0, f64::INFINITY);
}

/// As if the drawbar pull had not been measured.
pub fn lose_pull(seen: &mut Observation<f64>) {
    (seen.state.drawbar_pull_n, seen.noise.drawbar_pull_n) = (0.0, f64::INFINITY);
}

#[track_caller]
pub fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} against {expected} ± {tolerance}");
}
