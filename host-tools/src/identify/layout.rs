//! What the sensors of a run would show on another soil: the same slips, loads, numbers of rows and noise.

use std::ops::Range;

use kapvik_firmware::terramechanics::{Soil, Wheel};
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use crate::prior::DEEPEST;

use super::SensorNoise;
use super::combine::MeanState;

/// The mean states of a run, without what was measured of forces.
#[derive(Debug, Clone)]
pub struct Layout {
    wheel: Wheel<f64>,
    states: Vec<MeanState>,
    noises: Vec<WheelNoise<f64>>,
}

/// A run of some layout on some soil.
#[derive(Debug, Clone)]
pub struct Rehearsed {
    /// Its mean states, with noise.
    pub states: Vec<WheelState<f64>>,
    /// Pull, torque and sinkage at the mean slip and load less their means over the rows.
    pub bends: Vec<Forces>,
}

/// Drawbar pull (N), torque (N·m) and sinkage (m).
pub type Forces = [f64; 3];

impl Layout {
    /// Of a run's states.
    pub fn new(wheel: &Wheel<f64>, states: &[MeanState], noise: &SensorNoise) -> Self {
        let noises = states.iter().map(|state| noise.of_mean(state)).collect();
        Self { wheel: *wheel, states: states.to_vec(), noises }
    }

    /// Whether any state is a mean over different slips or loads.
    pub fn is_mixed(&self) -> bool {
        self.states.iter().any(|state| !state.spread.is_none())
    }

    /// Runs on soils, each drawn by `soil` with the numbers of one seed. Those that do not carry the wheels are left out, as they
    /// are in training.
    pub fn rehearse(
        &self,
        seeds: Range<u64>,
        soil: impl Fn(&mut ChaCha8Rng) -> Soil<f64> + Sync,
    ) -> Vec<(Soil<f64>, Rehearsed)> {
        let run = |index| {
            let mut random = ChaCha8Rng::seed_from_u64(index);
            let soil = soil(&mut random);
            Some((soil, self.on(&soil, &mut random)?))
        };
        seeds.into_par_iter().filter_map(run).collect()
    }

    /// How far the means lie beside the curve of a soil, state by state; none where it does not carry all of the wheels.
    pub fn bends(&self, soil: &Soil<f64>) -> Option<Vec<Forces>> {
        self.states.iter().map(|state| Some(self.mean(state, soil)?.1)).collect()
    }

    fn on(&self, soil: &Soil<f64>, random: &mut ChaCha8Rng) -> Option<Rehearsed> {
        let mut run = Rehearsed { states: Vec::new(), bends: Vec::new() };
        for (state, noise) in self.states.iter().zip(&self.noises) {
            let (mean, bend) = self.mean(state, soil)?;
            run.states.push(mean.blurred(noise, || StandardNormal.sample(random)));
            run.bends.push(bend);
        }
        Some(run)
    }

    /// The mean over a state's rows, and how far the state at the mean slip and load is from it.
    fn mean(&self, state: &MeanState, soil: &Soil<f64>) -> Option<(WheelState<f64>, Forces)> {
        let MeanState { mean, spread, .. } = state;
        let at = |slip, load_n| self.truth(soil, slip, load_n);
        let middle = at(mean.slip, mean.load_n)?;
        let seen = |[drawbar_pull_n, torque_nm, sinkage_m]: Forces| WheelState {
            drawbar_pull_n,
            load_n: mean.load_n,
            torque_nm,
            slip: mean.slip,
            sinkage_m: mean.sinkage_m.map(|_| sinkage_m),
        };
        if spread.is_none() {
            return Some((seen(middle), [0.0; 3]));
        }
        let mut sums = [0.0; 3];
        let corners = spread.corners(mean.slip, mean.load_n);
        for (slip, load_n) in &corners {
            let corner = at(*slip, *load_n)?;
            sums.iter_mut().zip(corner).for_each(|(sum, value)| *sum += value / corners.len() as f64);
        }
        Some((seen(sums), std::array::from_fn(|channel| middle[channel] - sums[channel])))
    }

    fn truth(&self, soil: &Soil<f64>, slip: f64, load_n: f64) -> Option<Forces> {
        let state = WheelState::under_load(&self.wheel, soil, slip, load_n).ok()?;
        let sinkage_m = state.sinkage_m.filter(|sinkage_m| *sinkage_m <= DEEPEST * self.wheel.radius_m)?;
        Some([state.drawbar_pull_n, state.torque_nm, sinkage_m])
    }
}
