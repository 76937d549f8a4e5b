//! Many instants of a run to few states: for the networks to those of at most six wheels.
//!
//! The rule. As many rows as there may be states are taken as they are, each a wheel. More are cut into groups of like slip
//! and load, and each group's mean is one wheel, its noise the smaller by the root of the number of rows (of
//! those that are independent: see `memory.rs`). So six wheels in
//! steady driving become six means over all instants, and one wheel whose slip changes becomes means along its way.
//!
//! The cut. Beginning with one group of all rows, the cut that most reduces the scatter within groups is made, until
//! there are as many as there may be, or nothing is left to cut. Scatter is measured in the units of [`ALIKE_SLIP`] and [`ALIKE_LOAD`]: as
//! far apart as two states can be before the curve between them bends noticeably. A group is left whole in a quantity
//! in which it scatters no more than its noise explains: cutting there would sort the rows by their errors. Where a cut runs
//! through rows all the same, what it sorts by errors is taken off: see `selection.rs`. How the rows of a group scatter
//! goes with its mean: see `spread.rs`.

use kapvik_firmware::terramechanics::effects::Conditions;
use kapvik_firmware::wheel_state::WheelState;

use super::followed::mean_conditions;
use super::memory::RowsPerReading;
use super::selection::{Bounds, mean_noise};
use super::spread::Spread;
use crate::statistics::sorted;

/// Slips that differ by this belong together as much as loads that differ by [`ALIKE_LOAD`].
pub const ALIKE_SLIP: f64 = 0.1;
/// Share of the load; forces grow nearly in proportion to it, so it may differ more than the slip.
pub const ALIKE_LOAD: f64 = 0.3;
/// Groups that are fine enough for rows to be steady in most.
const FINE_GROUPS: usize = 64;
/// A group scatters more than its noise explains above this ratio of standard deviations. Noise alone exceeds it in one
/// or two of a thousand groups of seven, and more rarely in greater ones.
const BEYOND_NOISE: f64 = 1.75;

/// What was measured in one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time within the run, s.
    pub t_s: f64,
    /// Slip i.
    pub slip: f64,
    /// Load W, N.
    pub load_n: f64,
    /// Drawbar pull DP, N, where it was measured.
    pub drawbar_pull_n: Option<f64>,
    /// Torque T, N·m, where it was measured.
    pub torque_nm: Option<f64>,
    /// Sinkage z, m, where it was measured.
    pub sinkage_m: Option<f64>,
    /// What else is known of the instant, which declared effects may follow.
    pub conditions: Conditions<f64>,
}

impl Sample {
    /// As the wheel state that a method sees: a pull or a torque that was not measured is zero there, and has no weight (see
    /// [`super::SensorNoise::of_mean`]).
    pub fn wheel_state(&self) -> WheelState<f64> {
        WheelState {
            drawbar_pull_n: self.drawbar_pull_n.unwrap_or(0.0),
            load_n: self.load_n,
            torque_nm: self.torque_nm.unwrap_or(0.0),
            slip: self.slip,
            sinkage_m: self.sinkage_m,
        }
    }
}

/// The mean of a group of samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanState {
    /// The means; those of pull, torque and sinkage over the rows that have one.
    pub mean: Sample,
    /// Rows in the mean.
    pub rows: usize,
    /// Rows in the mean of what not every row has.
    pub with: RowsWith,
    /// How many of the run's rows tell as much as one by itself.
    pub rows_per_reading: RowsPerReading,
    /// How their true slips and loads scatter about the mean.
    pub spread: Spread,
}

/// How many rows of a mean have what a row may lack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RowsWith {
    /// A drawbar pull.
    pub drawbar_pull: usize,
    /// A torque.
    pub torque: usize,
    /// A sinkage.
    pub sinkage: usize,
}

/// At most `most` mean states: the samples as they are and in their order where they are no more than that, else means by
/// slip and load. `slip_std` and `load_std_n` are the noise of one row.
pub fn combine(samples: &[Sample], most: usize, slip_std: f64, load_std_n: f64) -> Vec<MeanState> {
    if samples.len() <= most {
        return samples.iter().map(MeanState::of_row).collect();
    }
    let mean_load = mean(samples.iter().map(|sample| sample.load_n));
    let axes = [
        Axis { of: |sample| sample.slip, unit: ALIKE_SLIP, noise: slip_std },
        Axis { of: |sample| sample.load_n, unit: ALIKE_LOAD * mean_load, noise: load_std_n },
    ];
    let mut groups = vec![Group::new(samples.to_vec(), Bounds::NONE, &axes)];
    cut_into(&mut groups, most, &axes);
    let mut states: Vec<MeanState> =
        groups.iter().map(|group| MeanState::of(group, samples, [slip_std, load_std_n])).collect();
    cut_into(&mut groups, FINE_GROUPS, &axes);
    let rows_per_reading = rows_per_reading(groups, [slip_std, load_std_n]);
    states.iter_mut().for_each(|state| state.rows_per_reading = rows_per_reading);
    states.sort_by(|a, b| a.mean.slip.total_cmp(&b.mean.slip).then(a.mean.load_n.total_cmp(&b.mean.load_n)));
    states
}

/// How many rows tell as much as one by itself, from groups so fine that slip and load scatter by their noise alone in most.
fn rows_per_reading(groups: Vec<Group>, noise: [f64; 2]) -> RowsPerReading {
    let rows = groups.into_iter().map(|group| group.samples);
    let steady: Vec<Vec<Sample>> = rows.filter(|rows| Spread::of(rows, noise).is_none()).collect();
    RowsPerReading::of(&steady)
}

/// Cuts groups until there are `most`, or nothing is left to cut; none becomes empty.
fn cut_into(groups: &mut Vec<Group>, most: usize, axes: &[Axis; 2]) {
    while groups.len() < most {
        let best = groups.iter_mut().filter(|group| group.cut.is_some()).max_by(|a, b| a.gain().total_cmp(&b.gain()));
        let Some((group, cut)) = best.and_then(|group| group.cut.take().map(|cut| (group, cut))) else { break };
        let of = axes[cut.axis].of;
        let mut low = std::mem::take(&mut group.samples);
        low.sort_by(|a, b| of(a).total_cmp(&of(b)));
        let high = low.split_off(cut.place);
        let [below, above] = group.bounds.cut(cut.axis, cut.at);
        *group = Group::new(low, below, axes);
        groups.push(Group::new(high, above, axes));
    }
}

impl MeanState {
    fn of_row(sample: &Sample) -> Self {
        Self {
            mean: *sample,
            rows: 1,
            with: RowsWith::of(std::slice::from_ref(sample)),
            rows_per_reading: RowsPerReading::INDEPENDENT,
            spread: Spread::NONE,
        }
    }

    /// The mean of a group of all the samples, `noise` being that of slip and load.
    fn of(group: &Group, all: &[Sample], noise: [f64; 2]) -> Self {
        let rows = &group.samples;
        let conditions: Vec<_> = rows.iter().map(|sample| sample.conditions).collect();
        let errors = mean_noise(&group.bounds, all, rows.len(), noise);
        Self {
            mean: Sample {
                t_s: mean(rows.iter().map(|sample| sample.t_s)),
                slip: mean(rows.iter().map(|sample| sample.slip)) - errors[0],
                load_n: mean(rows.iter().map(|sample| sample.load_n)) - errors[1],
                drawbar_pull_n: mean_of_known(rows, |sample| sample.drawbar_pull_n),
                torque_nm: mean_of_known(rows, |sample| sample.torque_nm),
                sinkage_m: mean_of_known(rows, |sample| sample.sinkage_m),
                conditions: mean_conditions(&conditions),
            },
            rows: rows.len(),
            with: RowsWith::of(rows),
            rows_per_reading: RowsPerReading::INDEPENDENT,
            spread: Spread::of(rows, noise),
        }
    }
}

impl RowsWith {
    fn of(rows: &[Sample]) -> Self {
        let count = |of: fn(&Sample) -> Option<f64>| rows.iter().filter_map(of).count();
        Self {
            drawbar_pull: count(|row| row.drawbar_pull_n),
            torque: count(|row| row.torque_nm),
            sinkage: count(|row| row.sinkage_m),
        }
    }
}

/// A quantity that a group can be cut along.
#[derive(Clone, Copy)]
struct Axis {
    of: fn(&Sample) -> f64,
    /// The scale of likeness.
    unit: f64,
    /// One standard deviation of one row.
    noise: f64,
}

struct Group {
    samples: Vec<Sample>,
    /// Where the cuts are that left it.
    bounds: Bounds,
    /// The best cut, where there is one.
    cut: Option<Cut>,
}

#[derive(Clone, Copy)]
struct Cut {
    /// Place of the axis.
    axis: usize,
    /// Samples below the cut, once sorted along the axis.
    place: usize,
    /// In the middle between the samples on its two sides.
    at: f64,
    /// By how much the cut reduces the sum of squares, in units of likeness.
    gain: f64,
}

impl Group {
    fn new(samples: Vec<Sample>, bounds: Bounds, axes: &[Axis; 2]) -> Self {
        let cuts = (0..axes.len()).filter_map(|axis| best_cut(&samples, axes, axis));
        let cut = cuts.max_by(|a, b| a.gain.total_cmp(&b.gain));
        Self { samples, bounds, cut }
    }

    fn gain(&self) -> f64 {
        self.cut.map_or(0.0, |cut| cut.gain)
    }
}

/// The cut along an axis that leaves the least scatter on its two sides.
fn best_cut(samples: &[Sample], axes: &[Axis; 2], place_of_axis: usize) -> Option<Cut> {
    let axis = &axes[place_of_axis];
    let values = sorted(samples.iter().map(axis.of));
    let count = values.len() as f64;
    // About the mean, so that the sums of squares lose no digits.
    let centre = mean(values.iter().copied());
    let square_sum: f64 = values.iter().map(|value| (value - centre).powi(2)).sum();
    if (square_sum / count).sqrt() <= BEYOND_NOISE * axis.noise {
        return None;
    }
    let mut below = 0.0;
    let mut best: Option<Cut> = None;
    for (place, pair) in values.windows(2).enumerate() {
        below += pair[0] - centre;
        let low = (place + 1) as f64;
        // Between-group sum of squares; the sum above the cut is minus that below.
        let gain = below * below * (1.0 / low + 1.0 / (count - low)) / (axis.unit * axis.unit);
        if pair[0] < pair[1] && best.is_none_or(|best| gain > best.gain) {
            best = Some(Cut { axis: place_of_axis, place: place + 1, at: 0.5 * (pair[0] + pair[1]), gain });
        }
    }
    best
}

/// Over the rows that have it; none where none has.
fn mean_of_known(rows: &[Sample], of: fn(&Sample) -> Option<f64>) -> Option<f64> {
    let known = || rows.iter().filter_map(of);
    known().next().map(|_| mean(known()))
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(slip: f64, load_n: f64, drawbar_pull_n: f64) -> Sample {
        let conditions = Conditions::default();
        Sample {
            t_s: 0.0,
            slip,
            load_n,
            drawbar_pull_n: Some(drawbar_pull_n),
            torque_nm: Some(1.0),
            sinkage_m: None,
            conditions,
        }
    }

    /// Numbers that scatter like a sensor: a fixed sequence of −1, 0 and 1 with mean zero over six.
    fn scatter(place: usize) -> f64 {
        [1.0, -1.0, 0.0, -1.0, 1.0, 0.0][place % 6]
    }

    #[test]
    fn six_rows_stay_as_they_are() {
        let samples: Vec<Sample> = (0..6).map(|_| sample(0.2, 65.0, 3.0)).collect();
        let states = combine(&samples, 6, 0.01, 1.0);
        assert_eq!(states.len(), 6);
        assert!(states.iter().all(|state| state.rows == 1));
    }

    #[test]
    fn steady_wheels_become_their_means() {
        let rows = (0..60).flat_map(|instant| (0..6).map(move |wheel| (instant, wheel)));
        let samples: Vec<Sample> = rows
            .map(|(instant, wheel)| {
                sample(0.05 + 0.1 * f64::from(wheel) + 0.01 * scatter(instant), 65.0, f64::from(wheel))
            })
            .collect();
        let states = combine(&samples, 6, 0.01, 1.0);
        assert_eq!(states.iter().map(|state| state.rows).collect::<Vec<_>>(), [60; 6]);
        for (wheel, state) in states.iter().enumerate() {
            assert!((state.mean.slip - 0.05 - 0.1 * wheel as f64).abs() < 1e-12, "{state:?}");
            assert!((state.mean.drawbar_pull_n.expect("a pull") - wheel as f64).abs() < 1e-12, "{state:?}");
        }
    }

    #[test]
    fn a_slip_that_sweeps_becomes_six_states_along_its_way() {
        let samples: Vec<Sample> = (0..600).map(|row| sample(f64::from(row) / 1000.0, 65.0, 0.0)).collect();
        let states = combine(&samples, 6, 0.01, 1.0);
        assert_eq!(states.len(), 6);
        assert_eq!(states.iter().map(|state| state.rows).sum::<usize>(), 600);
        assert!(states.iter().all(|state| (75..=150).contains(&state.rows)), "{states:?}");
    }

    #[test]
    fn scatter_that_is_noise_is_not_cut() {
        let samples: Vec<Sample> =
            (0..120).map(|row| sample(0.3 + 0.01 * scatter(row), 65.0 + scatter(row / 6), 2.0)).collect();
        let states = combine(&samples, 6, 0.01, 1.0);
        assert_eq!(states.iter().map(|state| state.rows).collect::<Vec<_>>(), [120]);
    }

    #[test]
    fn wheels_that_differ_in_load_alone_are_told_apart() {
        let samples: Vec<Sample> =
            (0..100).map(|row| sample(0.3, if row % 2 == 0 { 40.0 } else { 90.0 }, 2.0)).collect();
        let states = combine(&samples, 6, 0.01, 1.0);
        assert_eq!(states.iter().map(|state| state.mean.load_n).collect::<Vec<_>>(), [40.0, 90.0]);
    }
}
