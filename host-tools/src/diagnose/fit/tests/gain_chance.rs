//! Chances of gains against the F test of a line and in repeated draws.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::toy::{Linear, Terms, blank, free, normal, plain, random, red};
use crate::diagnose::fit::{CHANNELS, Coordinate, Fit, Options, Reading, Row, Start, fit};
use crate::diagnose::gain_chance::Gain;

/// Readings of this many channels, a mean each and by `slope` times x; the slope is one parameter of all.
struct Lines {
    rows: Vec<Row>,
    channels: usize,
}

impl Lines {
    fn drawn(count: usize, channels: usize, slope: f64, seed: u64) -> Self {
        let mut random = random(seed);
        let row = |place: usize| {
            let mut row = blank(place);
            for channel in 0..channels {
                row.readings[channel] = Some(3.0 + slope * x(place) + normal(&mut random));
            }
            row
        };
        Self { rows: (0..count).map(row).collect(), channels }
    }

    fn fitted(&self, with_slope: bool, estimate_noise: bool) -> Fit {
        let mean_of = |channel: usize| std::array::from_fn(|c| if c == channel { 1.0 } else { 0.0 });
        let by_x = |place: usize| std::array::from_fn(|c| if c < self.channels { x(place) } else { 0.0 });
        let terms = |place: usize| Terms {
            constant: [0.0; CHANNELS],
            parameters: (0..self.channels).map(mean_of).chain(with_slope.then(|| by_x(place))).collect(),
            slip: [0.0; CHANNELS],
            load: [0.0; CHANNELS],
        };
        let coordinates: Vec<Coordinate> = (0..self.channels + usize::from(with_slope)).map(|_| free("p")).collect();
        let model = Linear { coordinates, terms: (0..self.rows.len()).map(terms).collect() };
        let options = Options { estimate_noise: [estimate_noise; CHANNELS], ..plain() };
        fit(&model, &self.rows, &Start::of(&model, &self.rows), &options).expect("a fit")
    }

    fn chance(&self, estimate_noise: bool) -> f64 {
        let [before, after] = [false, true].map(|with_slope| self.fitted(with_slope, estimate_noise));
        let ln_posterior = after.log_likelihood - before.log_likelihood;
        Gain { before: &before, after: &after, ln_posterior, dispersion: 1.0, rows_per_reading: 1.0 }.chance(1, 1)
    }
}

/// From −1 to 1 and back, for any number of rows.
fn x(place: usize) -> f64 {
    [-1.0, -0.3, 0.4, 1.0, 0.2, -0.6, 0.8][place % 7]
}

#[test]
fn one_channel_of_unknown_noise_is_the_f_test_of_a_line() {
    for (count, slope) in [(5, 0.0), (6, 2.0), (9, 4.0)] {
        let lines = Lines::drawn(count, 1, slope, count as u64);
        let values: Vec<f64> = lines.rows.iter().filter_map(|row| row.readings[0]).collect();
        let sum = |term: &dyn Fn(usize) -> f64| (0..count).map(term).sum::<f64>() / count as f64;
        let (of_x, of_y) = (sum(&x), sum(&|place| values[place]));
        let xx = sum(&|place| (x(place) - of_x).powi(2));
        let xy = sum(&|place| (x(place) - of_x) * (values[place] - of_y));
        let yy = sum(&|place| (values[place] - of_y).powi(2));
        let left = count as f64 - 2.0;
        let ratio = xy * xy / xx / (yy - xy * xy / xx) * left;
        let expected = FisherSnedecor::new(1.0, left).expect("a law").sf(ratio);
        let chance = lines.chance(true);
        assert!((chance - expected).abs() < 0.01 * expected, "{count} rows: {chance}, {expected}");
    }
}

/// The chance that is told of a drawbar pull that differs by so much times x between twelve runs of fifteen rows, whose noise keeps 0.7 from
/// row to row.
fn chance_between_runs(slope: f64, seed: u64) -> f64 {
    const RUNS: usize = 12;
    const ROWS: usize = 15;
    let pull = Reading::DrawbarPull.index();
    let mut random = random(seed);
    let of_run = |run: usize| {
        let mut noise = None;
        let row = |_| {
            noise = Some(red(noise, 0.7, &mut random));
            let mut row = blank(run);
            row.readings[pull] = noise.map(|noise| 3.0 + slope * x(run) + noise);
            row
        };
        (0..ROWS).map(row).collect::<Vec<_>>()
    };
    let rows: Vec<Row> = (0..RUNS).flat_map(of_run).collect();
    let fitted = |with_slope: bool| {
        let constant = |value: f64| std::array::from_fn(|c| if c == pull { value } else { 0.0 });
        let terms = |row: &Row| Terms {
            constant: [0.0; CHANNELS],
            parameters: [1.0].into_iter().chain(with_slope.then(|| x(row.run))).map(constant).collect(),
            slip: [0.0; CHANNELS],
            load: [0.0; CHANNELS],
        };
        let coordinates = (0..=usize::from(with_slope)).map(|_| free("p")).collect();
        let model = Linear { coordinates, terms: rows.iter().map(terms).collect() };
        let offsets = Options::default().offsets;
        fit(&model, &rows, &Start::of(&model, &rows), &Options { offsets, ..plain() }).expect("a fit")
    };
    let [before, after] = [false, true].map(fitted);
    let ln_posterior = after.log_posterior - before.log_posterior;
    let rows_per_reading = after.rows_per_reading();
    Gain { before: &before, after: &after, ln_posterior, dispersion: 1.0, rows_per_reading }.chance(1, 1)
}

/// Means of runs have forgotten one another, however well the rows of a run remember.
#[test]
fn what_differs_between_runs_is_not_lost_in_noise_that_remembers() {
    const DRAWS: u64 = 300;
    let chances: Vec<f64> = (0..DRAWS).map(|seed| chance_between_runs(0.0, seed)).collect();
    for level in [0.2, 0.05] {
        let below = chances.iter().filter(|chance| **chance < level).count() as f64 / (level * DRAWS as f64);
        println!("nothing differs: {below:.2} times {level}");
        assert!(below < 1.5, "{below:.2} times {level}");
    }
    let found = (0..20).filter(|seed| chance_between_runs(2.0, *seed) < 1e-3).count();
    assert!(found >= 19, "{found} of 20");
}

/// Of a slope that is not there, in three channels of so many readings each: about as often as they say, up to twice as often where
/// readings are few.
#[test]
fn chances_come_true() {
    const DRAWS: u64 = 1000;
    for (count, noise_is_unknown) in [(6, true), (9, true), (20, true), (6, false)] {
        let chance = |seed| Lines::drawn(count, 3, 0.0, 100 + seed).chance(noise_is_unknown);
        let chances: Vec<f64> = (0..DRAWS).map(chance).collect();
        for level in [0.2, 0.05] {
            let below = chances.iter().filter(|chance| **chance < level).count() as f64 / (level * DRAWS as f64);
            println!("{count} readings, noise unknown {noise_is_unknown}: {below:.2} times {level}");
            assert!((0.7..1.0 + 6.0 / count as f64).contains(&below), "{count} readings: {below:.2} times {level}");
        }
    }
}
