//! How many rows of a mean tell as much as one by itself.
//!
//! The noise of a mean falls with the root of the number of rows, if these are independent. A sensor that is read faster than its
//! noise changes says much the same many times: a mean of n rows is then as good as one of n / τ (statistics/autocorrelation.rs).

use crate::data::campaign::Channel;
use crate::statistics::autocorrelation::autocorrelation_time;

use super::combine::Sample;

/// For each channel, how many rows tell as much as an independent one: 1 or more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowsPerReading {
    /// Of the drawbar pull.
    pub drawbar_pull: f64,
    /// Of the load.
    pub load: f64,
    /// Of the torque.
    pub torque: f64,
    /// Of the slip.
    pub slip: f64,
    /// Of the sinkage.
    pub sinkage: f64,
}

impl RowsPerReading {
    /// Rows that remember nothing.
    pub const INDEPENDENT: Self = Self { drawbar_pull: 1.0, load: 1.0, torque: 1.0, slip: 1.0, sinkage: 1.0 };

    /// Which channels remember and how much, in words; none where none does.
    pub fn in_words(&self) -> Option<String> {
        let by_channel = [
            (Channel::Slip, self.slip),
            (Channel::Load, self.load),
            (Channel::DrawbarPull, self.drawbar_pull),
            (Channel::Torque, self.torque),
            (Channel::Sinkage, self.sinkage),
        ];
        let remembering = by_channel.into_iter().filter(|(_, rows)| *rows > 1.0);
        let words: Vec<String> =
            remembering.map(|(channel, rows)| format!("{rows:.1} of {}", channel.name())).collect();
        (!words.is_empty())
            .then(|| format!("noise remembers; rows that tell as much as an independent one: {}", words.join(", ")))
    }

    /// As the rows have it of groups in each of which slip and load are steady but for noise.
    pub fn of(steady: &[Vec<Sample>]) -> Self {
        let of_channel = |of: fn(&Sample) -> Option<f64>, follows: bool| {
            autocorrelation_time(steady.iter().map(|rows| series(rows, of, follows)).collect())
        };
        Self {
            drawbar_pull: of_channel(|row| row.drawbar_pull_n, true),
            load: of_channel(|row| Some(row.load_n), false),
            torque: of_channel(|row| row.torque_nm, true),
            slip: of_channel(|row| Some(row.slip), false),
            sinkage: of_channel(|row| row.sinkage_m, true),
        }
    }
}

/// What a channel leaves about its mean at each instant, in order of time; along a plane in slip and load where it follows these.
fn series(rows: &[Sample], of: fn(&Sample) -> Option<f64>, follows: bool) -> Vec<f64> {
    let known: Vec<(&Sample, f64)> = rows.iter().filter_map(|row| Some((row, of(row)?))).collect();
    let plane = Plane::through(&known, follows);
    let mut left: Vec<(f64, f64)> = known.iter().map(|(row, value)| (row.t_s, value - plane.at(row))).collect();
    left.sort_by(|a, b| a.0.total_cmp(&b.0));
    let instants = left.chunk_by(|a, b| a.0 == b.0);
    instants.map(|rows| rows.iter().map(|(_, value)| value).sum::<f64>() / rows.len() as f64).collect()
}

/// A channel to first order in slip and load.
struct Plane {
    slip: f64,
    load_n: f64,
    value: f64,
    by_slip: f64,
    by_load: f64,
}

impl Plane {
    /// Least squares; level where slip and load do not differ, or are not asked.
    fn through(known: &[(&Sample, f64)], follows: bool) -> Self {
        let count = known.len().max(1) as f64;
        let mean =
            |of: &dyn Fn(&Sample, f64) -> f64| known.iter().map(|(row, value)| of(row, *value)).sum::<f64>() / count;
        let (slip, load_n, value) = (mean(&|row, _| row.slip), mean(&|row, _| row.load_n), mean(&|_, value| value));
        let level = Self { slip, load_n, value, by_slip: 0.0, by_load: 0.0 };
        if !follows {
            return level;
        }
        let (ss, ll) = (mean(&|row, _| (row.slip - slip).powi(2)), mean(&|row, _| (row.load_n - load_n).powi(2)));
        let sl = mean(&|row, _| (row.slip - slip) * (row.load_n - load_n));
        let sv = mean(&|row, v| (row.slip - slip) * (v - value));
        let lv = mean(&|row, v| (row.load_n - load_n) * (v - value));
        let determinant = ss * ll - sl * sl;
        if determinant > 1e-9 * ss * ll {
            return Self {
                by_slip: (sv * ll - lv * sl) / determinant,
                by_load: (lv * ss - sv * sl) / determinant,
                ..level
            };
        }
        Self { by_slip: if ss > 0.0 { sv / ss } else { 0.0 }, ..level }
    }

    fn at(&self, row: &Sample) -> f64 {
        self.value + self.by_slip * (row.slip - self.slip) + self.by_load * (row.load_n - self.load_n)
    }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::terramechanics::effects::Conditions;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Eight groups of rows whose drawbar pull keeps a share of its noise from row to row.
    fn groups(kept: f64, rows: usize, seed: u64) -> Vec<Vec<Sample>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = move || -> f64 { StandardNormal.sample(&mut random) };
        let mut noise = normal();
        let mut row = |place: usize| {
            noise = kept * noise + (1.0 - kept * kept).sqrt() * normal();
            let (slip, load_n) = (0.2 + 0.01 * normal(), 65.0 + normal());
            let conditions = Conditions::default();
            Sample {
                t_s: place as f64,
                slip,
                load_n,
                drawbar_pull_n: Some(5.0 + noise),
                torque_nm: Some(1.0),
                sinkage_m: None,
                conditions,
            }
        };
        (0..8).map(|_| (0..rows).map(&mut row).collect()).collect()
    }

    #[test]
    fn independent_rows_count_as_many_as_they_are() {
        let found = (0..100).filter(|seed| RowsPerReading::of(&groups(0.0, 40, *seed)) == RowsPerReading::INDEPENDENT);
        assert!(found.count() >= 95);
    }

    /// τ of noise that keeps a share ρ from row to row is (1 + ρ) / (1 − ρ).
    #[test]
    fn rows_that_remember_count_less() {
        for (kept, expected) in [(0.5, 3.0), (0.9, 19.0), (0.98, 99.0)] {
            let all = (0..40).map(|seed| RowsPerReading::of(&groups(kept, 400, seed)));
            let mean = all.map(|rows| rows.drawbar_pull).sum::<f64>() / 40.0;
            assert!((0.75..=1.25).contains(&(mean / expected)), "{kept}: {mean} for {expected}");
        }
    }
}
