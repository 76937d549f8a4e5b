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
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let still = hold_still(values, rows_of_run);
    for run in rows_of_run {
        let known: Vec<usize> = run.iter().copied().filter(|row| values[*row].is_some()).collect();
        if still && known.len() >= ROWS_OF_RUN {
            shrink(values, &known.iter().map(|row| vec![*row]).collect::<Vec<_>>());
            groups.push(known);
        } else {
            groups.extend(known.into_iter().map(|row| vec![row]));
        }
    }
    let mut moved = Vec::new();
    for level in levels(values, groups) {
        if level.len() >= OF_LEVEL {
            shrink(values, &level);
            moved.push(level.concat());
        } else {
            moved.extend(level.into_iter().filter(|group| group.len() > 1));
        }
    }
    moved
}

/// Whether the scatter within runs is mostly noise.
fn hold_still(values: &[Option<(f64, f64)>], rows_of_run: &[Vec<usize>]) -> bool {
    let (mut scatter, mut noise) = (0.0, 0.0);
    for run in rows_of_run.iter().filter(|run| run.len() >= ROWS_OF_RUN) {
        let known: Vec<(f64, f64)> = run.iter().filter_map(|row| values[*row]).collect();
        let mean = known.iter().map(|(value, _)| value).sum::<f64>() / known.len().max(1) as f64;
        scatter += known.iter().map(|(value, _)| (value - mean).powi(2)).sum::<f64>();
        noise += known.iter().map(|(_, std)| std * std).sum::<f64>() - known.first().map_or(0.0, |(_, std)| std * std);
    }
    noise > 0.0 && scatter < (1.0 + STILL) * noise
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

/// Moves groups towards their common mean, as far as their scatter is that of their noise.
fn shrink(values: &mut [Option<(f64, f64)>], groups: &[Vec<usize>]) {
    let count = groups.len() as f64;
    let means: Vec<(f64, f64)> = groups.iter().map(|group| mean(values, group)).collect();
    let common = means.iter().map(|(mean, _)| mean).sum::<f64>() / count;
    let scatter = means.iter().map(|(mean, _)| (mean - common).powi(2)).sum::<f64>() / (count - 1.0).max(1.0);
    let noise = means.iter().map(|(_, std)| std * std).sum::<f64>() / count;
    let true_variance = (scatter - noise).max(0.0);
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
