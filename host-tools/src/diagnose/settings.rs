//! Slip and load as they were set, told from how noisily they were read.
//!
//! A reading of a quantity that a rig holds at a level scatters about the level. Whoever takes each reading for what the
//! wheel had, expects forces to follow the scatter, which they do not (regression dilution); the soil would then seem to
//! resist any change of load. So readings are moved to what they tell of the true value given all the others: towards the
//! mean of their run, where runs hold still, and of their level, as far as the scatter there is that of the noise
//! (empirical Bayes; James and Stein's shrinkage).

use super::fit::{Latent, Reading, Row};

/// Rows of a run that tell its scatter.
const ROWS_OF_RUN: usize = 3;
/// Values of a level that tell its scatter.
const OF_LEVEL: usize = 4;
/// True scatter over that of the noise below which runs hold still.
const STILL: f64 = 1.0;
/// Standard deviations of χ² beyond which scatter is more than chance.
const BEYOND_CHANCE: f64 = 3.0;
/// A gap between levels, in standard deviations of the noise.
const GAP: f64 = 4.0;

/// Rows whose slips, and rows whose loads, were moved towards each other.
#[derive(Debug, Clone, Default)]
pub struct Settled {
    slips: Vec<Vec<usize>>,
    loads: Vec<Vec<usize>>,
}

impl Settled {
    /// Slips and loads whose errors say nothing of what a fit leaves of the other readings.
    ///
    /// Those that a fit comes to are such where each reading stands by itself (Fuller 1987, Measurement Error Models). What was
    /// moved to the middle of others is not a reading any more but what they foretell: the true value scatters about it (Berkson
    /// 1950, J. Am. Stat. Assoc. 45:164), and the fitted one follows the same forces as the residuals do. There the scatter is
    /// that of the moved readings, and the fit says where their middle lies.
    pub fn apart_from_residuals(&self, rows: &[Row], fitted: &[Latent]) -> Vec<Latent> {
        let mut latents = fitted.to_vec();
        let mut move_all = |groups: &[Vec<usize>], reading: Reading, of: fn(&mut Latent) -> &mut f64| {
            for group in groups {
                let read = |row: &usize| Some((*row, rows[*row].readings[reading.index()]?));
                let known: Vec<(usize, f64)> = group.iter().filter_map(read).collect();
                let shifts = known.iter().map(|(row, value)| *of(&mut latents[*row]) - value);
                let shift = shifts.sum::<f64>() / group.len() as f64;
                for (row, value) in known {
                    *of(&mut latents[row]) = value + shift;
                }
            }
        };
        move_all(&self.slips, Reading::Slip, |latent| &mut latent.slip);
        move_all(&self.loads, Reading::Load, |latent| &mut latent.load_n);
        latents
    }
}

/// Moves slips and loads to what is expected of the true ones, and their noise to what is left unknown of them.
pub fn settle(rows: &mut [Row], rows_of_run: &[Vec<usize>]) -> Settled {
    let mut of = |reading: Reading| {
        let channel = reading.index();
        let read = |row: &Row| Some((row.readings[channel]?, row.noise[channel]));
        let mut values: Vec<_> = rows.iter().map(read).collect();
        let groups = settle_values(&mut values, rows_of_run);
        for (row, (value, std)) in rows.iter_mut().zip(values).filter_map(|(row, value)| Some((row, value?))) {
            (row.readings[channel], row.noise[channel]) = (Some(value), std);
        }
        groups
    };
    Settled { slips: of(Reading::Slip), loads: of(Reading::Load) }
}

/// The same for any quantity that a rig may hold at levels: for each row what was read of it, and one standard deviation of
/// that. The rows that were moved towards each other.
pub fn settle_values(values: &mut [Option<(f64, f64)>], rows_of_run: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let rows_known = |run: &Vec<usize>| run.iter().copied().filter(|row| values[*row].is_some()).collect::<Vec<_>>();
    let runs: Vec<Vec<usize>> = rows_of_run.iter().map(rows_known).collect();
    let rows: Vec<Vec<Vec<usize>>> = runs.iter().map(|run| run.iter().map(|row| vec![*row]).collect()).collect();
    let within = Scatter::within(values, rows.iter().filter(|rows| rows.len() >= ROWS_OF_RUN));
    let still = within.is_still();
    let (held, loose): (Vec<_>, Vec<_>) = rows.into_iter().partition(|rows| still && rows.len() >= ROWS_OF_RUN);
    for rows in &held {
        shrink(values, rows, &within);
    }
    let groups = held.iter().map(|rows| rows.concat()).chain(loose.into_iter().flatten()).collect();
    let levels = levels(values, groups);
    let (common, few): (Vec<_>, Vec<_>) = levels.into_iter().partition(|level| level.len() >= OF_LEVEL);
    // Loads that were set one by one make a level by chance, and say nothing of how well others were held.
    let is_held = |level: &&Vec<Vec<usize>>| {
        let own = Scatter::about_the_middle(values, level);
        !own.exceeds(STILL * own.noise / own.freedom)
    };
    let between = Scatter::within(values, common.iter().filter(is_held));
    for level in &common {
        shrink(values, level, &between);
    }
    let held_alone = few.into_iter().flatten().filter(|group| group.len() > 1);
    common.iter().map(|level| level.concat()).chain(held_alone).collect()
}

/// How far readings scatter about the middle of theirs, and how far they would by noise alone.
#[derive(Debug, Clone, Copy, Default)]
struct Scatter {
    /// Sum of squares about the middle.
    squares: f64,
    /// What is expected of that sum.
    noise: f64,
    /// Degrees of freedom of both.
    freedom: f64,
}

impl Scatter {
    /// That within runs, or within levels, all together: a few readings alone hardly tell it.
    fn within<'a>(values: &[Option<(f64, f64)>], all: impl Iterator<Item = &'a Vec<Vec<usize>>>) -> Self {
        all.map(|groups| Self::about_the_middle(values, groups)).fold(Self::default(), |sum, own| Self {
            squares: sum.squares + own.squares,
            noise: sum.noise + own.noise,
            freedom: sum.freedom + own.freedom,
        })
    }

    /// That of the means of groups.
    fn about_the_middle(values: &[Option<(f64, f64)>], groups: &[Vec<usize>]) -> Self {
        let means: Vec<(f64, f64)> = groups.iter().map(|group| mean(values, group)).collect();
        let count = means.len().max(1) as f64;
        let common = means.iter().map(|(mean, _)| mean).sum::<f64>() / count;
        let variance = means.iter().map(|(_, std)| std * std).sum::<f64>() / count;
        Self {
            squares: means.iter().map(|(mean, _)| (mean - common).powi(2)).sum(),
            noise: variance * (count - 1.0),
            freedom: count - 1.0,
        }
    }

    /// The variance of the true values, as far as the scatter is more than that of noise.
    fn true_variance(&self) -> f64 {
        ((self.squares - self.noise) / self.freedom.max(1.0)).max(0.0)
    }

    /// Whether the true values hold still.
    fn is_still(&self) -> bool {
        self.noise > 0.0 && self.squares < (1.0 + STILL) * self.noise
    }

    /// Whether it is more than one of a true variance beyond chance.
    fn exceeds(&self, true_variance: f64) -> bool {
        let expected = self.noise + self.freedom * true_variance;
        self.squares > expected * (1.0 + BEYOND_CHANCE * (2.0 / self.freedom.max(1.0)).sqrt())
    }
}

/// Groups whose means lie closer than a gap, in one level each.
fn levels(values: &[Option<(f64, f64)>], mut groups: Vec<Vec<usize>>) -> Vec<Vec<Vec<usize>>> {
    let middle = |group: &[usize]| mean(values, group);
    groups.sort_by(|a, b| middle(a).0.total_cmp(&middle(b).0));
    let mut levels: Vec<Vec<Vec<usize>>> = Vec::new();
    for group in groups {
        let (here, std) = middle(&group);
        let near = levels.last().and_then(|level| level.last()).is_some_and(|last| here - middle(last).0 < GAP * std);
        match levels.last_mut() {
            Some(level) if near => level.push(group),
            _ => levels.push(vec![group]),
        }
    }
    levels
}

/// Mean and middling noise of a group.
fn mean(values: &[Option<(f64, f64)>], group: &[usize]) -> (f64, f64) {
    let known = group.iter().filter_map(|row| values[*row]);
    let (sum, squares, count) = known
        .fold((0.0, 0.0, 0.0), |(sum, squares, count), (value, std)| (sum + value, squares + std * std, count + 1.0));
    (sum / f64::max(count, 1.0), (squares / f64::max(count, 1.0)).sqrt())
}

/// Moves groups towards their common mean, as far as the scatter of all such is that of noise; of groups that scatter more
/// than the others beyond chance, as far as their own is.
fn shrink(values: &mut [Option<(f64, f64)>], groups: &[Vec<usize>], of_all: &Scatter) {
    let count = groups.len() as f64;
    let means: Vec<(f64, f64)> = groups.iter().map(|group| mean(values, group)).collect();
    let common = means.iter().map(|(mean, _)| mean).sum::<f64>() / count;
    let noise = means.iter().map(|(_, std)| std * std).sum::<f64>() / count;
    let own = Scatter::about_the_middle(values, groups);
    let true_variance = if own.exceeds(of_all.true_variance()) { own.true_variance() } else { of_all.true_variance() };
    let kept = true_variance / (true_variance + noise).max(f64::MIN_POSITIVE);
    let std = (kept * noise + noise / count).sqrt().min(noise.sqrt());
    for (group, (mean, _)) in groups.iter().zip(&means) {
        let moved = (1.0 - kept) * (common - mean);
        for row in group {
            values[*row] = values[*row].map(|(value, _)| (value + moved, std));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::fit::CHANNELS;

    fn row(run: usize, load_n: f64) -> Row {
        let mut readings = [None; CHANNELS];
        readings[Reading::Load.index()] = Some(load_n);
        Row { run, readings, noise: [1.0; CHANNELS] }
    }

    fn load(row: &Row) -> (f64, f64) {
        let load = Reading::Load.index();
        (row.readings[load].expect("a load"), row.noise[load])
    }

    /// Scatter of less than the noise is all noise: every row at the mean, known to σ/√n.
    #[test]
    fn one_level_is_one_load() {
        let mut rows: Vec<Row> =
            [24.5, 25.5, 25.0, 24.0, 26.0].into_iter().enumerate().map(|(run, n)| row(run, n)).collect();
        let runs: Vec<Vec<usize>> = (0..5).map(|row| vec![row]).collect();
        settle(&mut rows, &runs);
        assert!(rows.iter().all(|row| load(row) == (25.0, 1.0 / 5_f64.sqrt())));
    }

    /// Loads far apart are what they are.
    #[test]
    fn spread_loads_stay() {
        let loads: Vec<f64> = (0..20).map(|place| 30.0 + 10.0 * f64::from(place)).collect();
        let mut rows: Vec<Row> = loads.iter().enumerate().map(|(run, n)| row(run, *n)).collect();
        let runs: Vec<Vec<usize>> = (0..20).map(|row| vec![row]).collect();
        settle(&mut rows, &runs);
        assert!(rows.iter().zip(&loads).all(|(row, load_n)| load(row) == (*load_n, 1.0)));
    }

    /// Two levels of runs that hold still: each run at its level.
    #[test]
    fn runs_at_two_levels() {
        let mut rows = Vec::new();
        for run in 0..8 {
            let level = if run % 2 == 0 { 30.0 } else { 60.0 };
            rows.extend([-1.0, 0.0, 1.0].map(|noise| row(run, level + noise)));
        }
        let runs: Vec<Vec<usize>> = (0..8).map(|run| (3 * run..3 * run + 3).collect()).collect();
        settle(&mut rows, &runs);
        assert!(rows.iter().all(|row| (load(row).0 - if row.run % 2 == 0 { 30.0 } else { 60.0 }).abs() < 1e-9));
        assert!(rows.iter().all(|row| load(row).1 < 0.5));
    }

    /// The scatter of a few rows by themselves is now more, now less than that of the noise; what all runs together show counts for
    /// each. A run that ramps is none of them.
    #[test]
    fn runs_share_what_they_tell_of_the_noise() {
        let (quiet, lively, ramp) = ([-0.3, 0.0, 0.3, 0.0], [-1.9, 1.9, -1.9, 1.9], [-3.0, -1.0, 1.0, 3.0]);
        let mut rows = Vec::new();
        for run in 0..20 {
            let noise = if run == 19 {
                ramp
            } else if run % 4 == 0 {
                lively
            } else {
                quiet
            };
            rows.extend(noise.map(|noise| row(run, 100.0 * (run + 1) as f64 + noise)));
        }
        let runs: Vec<Vec<usize>> = (0..20).map(|run| (4 * run..4 * run + 4).collect()).collect();
        settle(&mut rows, &runs);
        let spread = |run: usize| load(&rows[4 * run + 3]).0 - load(&rows[4 * run + 2]).0;
        assert!(spread(4) < 1.6, "by its own scatter 3.0 would be left: {}", spread(4));
        assert!(spread(19) > 1.5, "{}", spread(19));
    }

    /// Where loads were moved to a level, what the fit made of each by its own forces counts no more than the level's mean does;
    /// a load that was left alone is where the fit has it.
    #[test]
    fn residuals_do_not_reach_loads_that_were_moved() {
        let mut rows: Vec<Row> =
            [24.5, 25.5, 25.0, 24.0, 26.0, 80.0].into_iter().zip(0..).map(|(n, run)| row(run, n)).collect();
        let settled = settle(&mut rows, &(0..6).map(|row| vec![row]).collect::<Vec<_>>());
        let fitted: Vec<Latent> =
            [26.0, 24.0, 25.5, 25.5, 26.5, 81.0].map(|load_n| Latent { slip: 0.3, load_n, sinkage_m: 0.01 }).into();
        let apart: Vec<f64> = settled.apart_from_residuals(&rows, &fitted).iter().map(|latent| latent.load_n).collect();
        assert_eq!(apart, [25.5, 25.5, 25.5, 25.5, 25.5, 81.0]);
    }
}
