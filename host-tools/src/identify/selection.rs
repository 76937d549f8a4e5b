//! What cutting rows by their slip and load does to the noise in these.
//!
//! Below a cut lie the rows that noise has pushed there, above it those that it has pushed up: the noise of a group has a
//! mean, which no number of rows averages away. Where p is how many rows there are for each unit of what was measured y, and
//! σ the noise, the mean noise of a row at y is −σ² p′/p (M. C. K. Tweedie, for any distribution of the truth). Summed from
//! one end of a group to the other that is σ² times p at its lower cut less p at its upper one: nothing where the cuts lie in
//! gaps, as between the wheels of a rover that keep their slips.

use super::combine::Sample;

/// Between which slips and loads (N) a group lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    /// Everywhere.
    pub const NONE: Self = Self { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };

    /// The parts below and above a cut along the axis of slip (0) or load (1).
    pub fn cut(self, axis: usize, at: f64) -> [Self; 2] {
        let (mut below, mut above) = (self, self);
        below.high[axis] = at;
        above.low[axis] = at;
        [below, above]
    }

    fn contains(&self, axis: usize, value: f64) -> bool {
        self.low[axis] <= value && value <= self.high[axis]
    }
}

/// The mean noise in slip and load of a group of `rows` of all `samples` that lies within bounds. `noise` is one standard
/// deviation of a row.
pub fn mean_noise(bounds: &Bounds, samples: &[Sample], rows: usize, noise: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let std = noise[axis];
        if std <= 0.0 {
            return 0.0;
        }
        // Rows a unit, over a standard deviation to either side: what noise has blurred has no finer detail.
        let density = |cut: f64| {
            let near = |sample: &&Sample| {
                let measured = [sample.slip, sample.load_n];
                (measured[axis] - cut).abs() <= std && bounds.contains(1 - axis, measured[1 - axis])
            };
            samples.iter().filter(near).count() as f64 / (2.0 * std)
        };
        std * std * (density(bounds.low[axis]) - density(bounds.high[axis])) / rows as f64
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kapvik_firmware::terramechanics::effects::Conditions;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    const STD: f64 = 0.01;

    fn sample(slip: f64) -> Sample {
        let conditions = Conditions::default();
        Sample { t_s: 0.0, slip, load_n: 65.0, drawbar_pull_n: None, torque_nm: None, sinkage_m: None, conditions }
    }

    /// Rows with slips from 0 to 0.1, with noise, cut at 0.05: what is taken for the mean noise below and above, and the truth.
    #[test]
    fn the_noise_that_a_cut_sorts_out_is_known() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let truths: Vec<f64> = (0..4000).map(|row| 0.1 * f64::from(row) / 4000.0).collect();
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let noises: Vec<f64> = truths.iter().map(|_| STD * normal()).collect();
        let samples: Vec<Sample> = truths.iter().zip(&noises).map(|(truth, noise)| sample(truth + noise)).collect();
        for (bounds, sign) in Bounds::NONE.cut(0, 0.05).into_iter().zip([-1.0, 1.0]) {
            let inside: Vec<f64> = samples
                .iter()
                .zip(&noises)
                .filter(|(sample, _)| bounds.contains(0, sample.slip))
                .map(|(_, noise)| *noise)
                .collect();
            let truth = inside.iter().sum::<f64>() / inside.len() as f64;
            let [found, of_load] = mean_noise(&bounds, &samples, inside.len(), [STD, 1.0]);
            assert!(sign * truth > 1e-3, "{truth}");
            // Two thousand noises have a mean that scatters by 0.0002.
            assert!((found - truth).abs() < 6e-4, "{found}, truth {truth}");
            assert!(of_load.abs() < 1e-12);
        }
    }

    #[test]
    fn a_cut_in_a_gap_sorts_nothing_out() {
        let samples: Vec<Sample> = (0..40).map(|row| sample(if row % 2 == 0 { 0.1 } else { 0.3 })).collect();
        let [below, above] = Bounds::NONE.cut(0, 0.2);
        assert_eq!(mean_noise(&below, &samples, 20, [STD, 1.0]), [0.0; 2]);
        assert_eq!(mean_noise(&above, &samples, 20, [STD, 1.0]), [0.0; 2]);
        assert_eq!(mean_noise(&below, &samples, 20, [0.0; 2]), [0.0; 2]);
    }
}
