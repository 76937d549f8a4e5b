//! The passes over the rows.

use indicatif::ProgressBar;
use kapvik_firmware::estimator::doubt::DoubtNetwork;
use rayon::prelude::*;

use super::pass::slope_of;
use super::rows::SideRows;
use super::standardise::Standard;
use super::weights::DoubtWeights;
use crate::train::cosine_fall::cosine_fall;
use crate::train::dataset::shuffle;
use crate::train::lanes::LANES;
use crate::train::moments::Moments;
use crate::train::trainable::{change_each, flatten};

/// Passes over all sides.
const PASSES: u64 = 100;
/// Sides of a step.
const BATCH: usize = 2 * LANES;
/// Step size at the beginning; it falls to zero along a half-wave of the cosine.
const RATE: f32 = 5.0e-3;

/// The network that makes the errors on these sides of drives most likely, as it flies. Their inputs are standardised where they are.
pub fn train(sides: &mut [SideRows], seed: u32, progress: &ProgressBar) -> DoubtNetwork {
    let standard = Standard::of(sides);
    sides.par_iter_mut().flatten().for_each(|row| standard.apply(&mut row.inputs));
    let seed = u64::from(seed) << 16;
    let mut weights = DoubtWeights::initial(seed);
    let mut moments = Moments::new(&weights);
    let mut order: Vec<u32> = (0..sides.len() as u32).collect();
    let steps = PASSES * order.len().div_ceil(BATCH) as u64;
    let mut done = 0;
    progress.set_length(PASSES);
    for pass in 1..=PASSES {
        shuffle(&mut order, seed + pass);
        let (mut loss, mut rows) = (0.0, 0);
        for batch in order.chunks(BATCH) {
            let rate = RATE * cosine_fall(done as f32 / steps as f32);
            let mut slope = slope_of(&weights, sides, batch);
            let share = 1.0 / slope.rows.max(1) as f32;
            change_each(&mut slope.gradient, std::iter::repeat(share), |sum, share| *sum *= share);
            moments.step(&mut weights, &flatten(&slope.gradient), rate);
            loss += f64::from(slope.loss);
            rows += slope.rows;
            done += 1;
        }
        progress.set_message(format!("loss {:.4}", loss / f64::from(rows.max(1))));
        progress.inc(1);
    }
    standard.folded_into(&weights).rounded(&standard.mean)
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::estimator::doubt::OUTPUTS;
    use kapvik_firmware::math::octaves;
    use kapvik_firmware::rover::PerAxle;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::doubt::held_out::{Tally, believed, flown};
    use crate::doubt::rows::{Known, Precision, Row};
    use crate::train::dataset::stream;

    /// The logarithm by which errors exceed what is stated, where the input that tells of it has this value and had such a mean lately.
    fn excess(now: f32, lately: f32) -> f32 {
        0.2 + 0.4 * libm::tanhf(now) + 0.6 * libm::tanhf(3.0 * lately)
    }

    /// What is known of each input of row after row, so that `excess` is known of each.
    fn excesses(rows: &[Row]) -> Vec<f32> {
        let mut lately = 0.0;
        let of_row = |row: &Row| {
            let now = 2.0 * (row.inputs[7] + 3.9);
            lately += (now - lately) / 16.0;
            excess(now, lately)
        };
        rows.iter().map(of_row).collect()
    }

    fn sides(count: usize, seed: u64) -> Vec<SideRows> {
        let mut random = stream(seed, 0);
        let mut normal = || -> f32 { StandardNormal.sample(&mut random) };
        let alone = Precision {
            torque_slip: [[1.0, 0.0], [0.0, 1.0]],
            contact: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        let mut side = |_| {
            let row = |_| Row::new(&std::array::from_fn(|k| 0.3 * k as f32 - 6.0 + 0.5 * normal()));
            let mut rows: SideRows = (0..100).map(row).collect();
            for (place, excess) in excesses(&rows).into_iter().enumerate() {
                let errors = std::array::from_fn(|_| libm::expf(excess) * normal());
                rows[place].known = Some(Known { errors, wheels: PerAxle::all(alone) });
            }
            rows
        };
        (0..count).map(&mut side).collect()
    }

    #[test]
    fn what_hangs_on_one_input_now_and_before_is_learned() {
        let network = train(&mut sides(600, 1), 1, &ProgressBar::hidden());
        assert!(network.cannot_overflow());
        let held_out = sides(60, 2);
        let ideal = |rows: &[Row]| {
            let outputs = excesses(rows).into_iter().map(|excess| [octaves(libm::expf(excess)); OUTPUTS]);
            outputs.collect()
        };
        let ideal = Tally::of(&held_out, ideal).mean_loss();
        let [before, after] = [Tally::of(&held_out, believed), Tally::of(&held_out, |rows| flown(&network, rows))]
            .map(|tally| tally.mean_loss() - ideal);
        println!("above the ideal loss: {before:.3} before, {after:.3} after");
        assert!(after < 0.03 * before, "{after}, {before}");
    }

    #[test]
    fn the_same_rows_give_the_same_bits() {
        let once = || train(&mut sides(40, 3), 3, &ProgressBar::hidden());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
        assert_eq!(once(), pool.install(once));
    }
}
