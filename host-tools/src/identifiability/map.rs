//! The map of identifiability: how long it takes until a parameter is known, over the spread of slip and of load.

use kapvik_firmware::terramechanics::{Soil, Wheel};
use rayon::prelude::*;

use crate::parameter::Parameter;

use super::bound::Bound;
use super::single_wheel::WheelMeasurement;
use super::spread::{Spread, SpreadInformation, WheelsInTurn};

/// Wheels that a map is drawn for.
pub const DESIGNS: [WheelsInTurn; 5] = [
    WheelsInTurn { wheels: 1, stations_each: 6 },
    WheelsInTurn { wheels: 2, stations_each: 3 },
    WheelsInTurn { wheels: 3, stations_each: 2 },
    WheelsInTurn { wheels: 6, stations_each: 1 },
    WheelsInTurn { wheels: 6, stations_each: 6 },
];
/// Slip about which slips are spread.
pub const MIDDLE_SLIP: f64 = 0.325;
/// Greatest spread of slip, from least to greatest: 0.05 … 0.60.
pub const GREATEST_SLIP_SPREAD: f64 = 0.55;
/// Greatest half spread of load over its mean.
pub const GREATEST_LOAD_SHARE: f64 = 0.5;
/// Cells along the spread of slip.
pub const SLIP_CELLS: usize = 22;
/// Cells along the spread of load.
pub const LOAD_CELLS: usize = 20;
/// Longest averaging that is looked at, s; the shortest is that of one instant.
pub const LONGEST_S: f64 = 3600.0;
/// Halvings of the range of times.
const HALVINGS: usize = 12;

/// What a map is drawn of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapQuestion {
    /// All wheels.
    pub wheel: Wheel<f64>,
    /// Mean load of a wheel, N.
    pub load_n: f64,
    /// The soil.
    pub soil: Soil<f64>,
    /// How the wheels are measured.
    pub measurement: WheelMeasurement,
    /// Independent instants in a second.
    pub instants_per_second: f64,
    /// Accuracy asked for, as a share of the value.
    pub accuracy: f64,
}

/// A place of the map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Greatest less least slip.
    pub slip_spread: f64,
    /// Half of the spread of load over its mean.
    pub load_share: f64,
    /// For each of [`DESIGNS`], the averaging time (s) until each target is known; none where no hour
    /// is enough.
    pub times_s: [PerTarget<Option<f64>>; DESIGNS.len()],
    /// Standard deviation over the value after [`LONGEST_S`], for the same.
    pub at_last: [PerTarget<f64>; DESIGNS.len()],
}

/// One value for each target.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PerTarget<T>([T; 3]);

impl<T> PerTarget<T> {
    /// A value for each target.
    pub fn from_fn(mut value: impl FnMut(Parameter) -> T) -> Self {
        Self(Parameter::ALL.map(&mut value))
    }

    /// The value of a target.
    pub fn of(&self, target: Parameter) -> &T {
        &self.0[target as usize]
    }
}

/// Centre of a cell along an axis of `count` cells up to `greatest`.
fn centre(place: usize, count: usize, greatest: f64) -> f64 {
    (place as f64 + 0.5) / count as f64 * greatest
}

/// The cells, row by row of load spread. `done` is called after each.
pub fn map(question: &MapQuestion, done: impl Fn() + Sync) -> Vec<Cell> {
    let cell = |index: usize| {
        let slip_spread = centre(index % SLIP_CELLS, SLIP_CELLS, GREATEST_SLIP_SPREAD);
        let load_share = centre(index / SLIP_CELLS, LOAD_CELLS, GREATEST_LOAD_SHARE);
        let found = question.cell(slip_spread, load_share);
        done();
        found
    };
    (0..SLIP_CELLS * LOAD_CELLS).into_par_iter().map(cell).collect()
}

impl MapQuestion {
    /// The map at a place.
    pub fn cell(&self, slip_spread: f64, load_share: f64) -> Cell {
        let spread = Spread {
            slip_low: MIDDLE_SLIP - 0.5 * slip_spread,
            slip_high: MIDDLE_SLIP + 0.5 * slip_spread,
            load_n: self.load_n,
            load_share,
        };
        let information = spread.information(&self.measurement, &self.wheel, &self.soil);
        let information = information.as_ref();
        let times_s = DESIGNS.map(|design| PerTarget::from_fn(|target| self.time_s(information?, design, target)));
        let at_last = DESIGNS.map(|design| {
            let bound = information.and_then(|information| self.bound(information, design, LONGEST_S));
            PerTarget::from_fn(|target| bound.map_or(f64::INFINITY, |bound| bound.relative(target, &self.soil)))
        });
        Cell { slip_spread, load_share, times_s, at_last }
    }

    fn bound(&self, information: &SpreadInformation, design: WheelsInTurn, time_s: f64) -> Option<Bound> {
        information.bound(&self.measurement, design, time_s * self.instants_per_second)
    }

    /// Averaging time until a target is known: errors only shrink with time.
    fn time_s(&self, information: &SpreadInformation, design: WheelsInTurn, target: Parameter) -> Option<f64> {
        let known_after = |time_s: f64| {
            let bound = self.bound(information, design, time_s);
            bound.is_some_and(|bound| bound.relative(target, &self.soil) <= self.accuracy)
        };
        shortest(1.0 / self.instants_per_second, LONGEST_S, HALVINGS, known_after)
    }
}

/// The shortest time between two for which something holds that keeps holding, by halving the ratio of its bounds; none
/// where it does not hold after the longest.
pub fn shortest(least_s: f64, longest_s: f64, halvings: usize, holds_after: impl Fn(f64) -> bool) -> Option<f64> {
    if holds_after(least_s) {
        return Some(least_s);
    }
    if !holds_after(longest_s) {
        return None;
    }
    let (mut low, mut high) = (least_s, longest_s);
    for _ in 0..halvings {
        let middle = (low * high).sqrt();
        if holds_after(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}
