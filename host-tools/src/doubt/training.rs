//! The passes over the rows.

use indicatif::ProgressBar;
use kapvik_firmware::estimator::doubt::DoubtNetwork;
use rayon::prelude::*;

use super::pass::{Slope, slope_of};
use super::rows::Row;
use super::standardise::Standard;
use super::weights::DoubtWeights;
use crate::train::dataset::shuffle;
use crate::train::moments::Moments;
use crate::train::trainable::{change_each, flatten};

/// Passes over all rows.
const PASSES: u64 = 40;
/// Rows of a step.
const BATCH: usize = 4096;
/// Rows that are summed by themselves, so that the result does not depend on the number of cores.
const PART: usize = BATCH / 8;
/// Step size at the beginning; it falls to zero along a half-wave of the cosine.
const RATE: f64 = 5.0e-3;

/// The network that makes the rows most likely, as it flies. Their inputs are standardised where they are.
pub fn train(rows: &mut [Row], seed: u32, progress: &ProgressBar) -> DoubtNetwork {
    let standard = Standard::of(rows);
    rows.par_iter_mut().for_each(|row| standard.apply(&mut row.inputs));
    let seed = u64::from(seed) << 16;
    let mut weights = DoubtWeights::initial(seed);
    let mut moments = Moments::new(&weights);
    let mut order: Vec<u32> = (0..rows.len() as u32).collect();
    let steps = PASSES * order.len().div_ceil(BATCH) as u64;
    let mut done = 0_u64;
    progress.set_length(PASSES);
    for pass in 1..=PASSES {
        shuffle(&mut order, seed + pass);
        let mut loss = 0.0;
        for batch in order.chunks(BATCH) {
            let rate = RATE * 0.5 * (1.0 + libm::cos(std::f64::consts::PI * done as f64 / steps as f64));
            let Slope { loss: sum, gradient } = mean_slope(&weights, rows, batch);
            moments.step(&mut weights, &flatten(&gradient), rate as f32);
            loss += f64::from(sum) * batch.len() as f64;
            done += 1;
        }
        progress.set_message(format!("loss {:.4}", loss / rows.len().max(1) as f64));
        progress.inc(1);
    }
    standard.folded_into(&weights).rounded(&standard.mean)
}

/// Mean loss of the rows at these places and its slope.
fn mean_slope(weights: &DoubtWeights, rows: &[Row], places: &[u32]) -> Slope {
    let parts: Vec<Slope> = places.par_chunks(PART).map(|part| slope_of(weights, rows, part)).collect();
    let share = 1.0 / places.len() as f32;
    let mut mean = Slope { loss: 0.0, gradient: DoubtWeights::ZERO };
    for part in &parts {
        change_each(&mut mean.gradient, flatten(&part.gradient), |sum, slope| *sum += share * slope);
        mean.loss += share * part.loss;
    }
    mean
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::estimator::doubt::{INPUTS, OUTPUTS};
    use kapvik_firmware::math::octaves;
    use kapvik_firmware::rover::PerAxle;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::doubt::held_out::Tally;
    use crate::doubt::rows::Precision;
    use crate::train::dataset::stream;

    /// The logarithm by which errors exceed what is stated, where the input that tells of it has this value.
    fn excess(input: f32) -> f32 {
        0.2 + 0.6 * libm::tanhf(input)
    }

    fn rows(count: usize, seed: u64) -> Vec<Row> {
        let mut random = stream(seed, 0);
        let mut normal = || -> f32 { StandardNormal.sample(&mut random) };
        let alone = Precision {
            torque_slip: [[1.0, 0.0], [0.0, 1.0]],
            contact: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        let row = |_| {
            let inputs: [f32; INPUTS] = std::array::from_fn(|k| 0.3 * k as f32 - 6.0 + 0.5 * normal());
            let times = libm::expf(excess(2.0 * (inputs[7] + 3.9)));
            Row { inputs, errors: std::array::from_fn(|_| times * normal()), wheels: PerAxle::all(alone) }
        };
        (0..count).map(row).collect()
    }

    #[test]
    fn what_hangs_on_one_input_is_learned() {
        let network = train(&mut rows(60_000, 1), 1, &ProgressBar::hidden());
        assert!(network.cannot_overflow());
        let held_out = rows(5_000, 2);
        let ideal = Tally::of(&held_out, |row| [octaves(libm::expf(excess(2.0 * (row.inputs[7] + 3.9)))); OUTPUTS]);
        let [before, after] =
            [Tally::of(&held_out, |_| [0.0; OUTPUTS]), Tally::of(&held_out, |row| network.run(&row.inputs))];
        let [before, after] = [before, after].map(|tally| tally.mean_loss() - ideal.mean_loss());
        println!("above the ideal loss: {before:.3} before, {after:.3} after");
        assert!(after < 0.03 * before, "{after}, {before}");
    }

    #[test]
    fn the_same_rows_give_the_same_bits() {
        let once = || train(&mut rows(600, 3), 3, &ProgressBar::hidden());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        assert_eq!(once(), pool.install(once));
    }
}
