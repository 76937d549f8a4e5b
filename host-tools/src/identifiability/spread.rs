//! Wheels whose slips and loads are spread.

use kapvik_firmware::terramechanics::{Soil, Wheel};

use super::bound::Bound;
use super::information::Information;
use super::single_wheel::{Station, WheelMeasurement};

/// Stations of a spread.
pub const STATIONS: usize = 6;

/// Place of the load of each station in its range, −1 … 1, in the order of the slips: equal steps in an order that is hardly
/// correlated with slip. With ±8 % it gives the table of an independent implementation (`tests/identifiability.rs`) within 1 %, but for one row (3 %).
const LOAD_PLACES: [f64; STATIONS] = [1.0, -0.6, 0.6, -0.2, -1.0, 0.2];

/// Slips and loads of six stations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Least slip.
    pub slip_low: f64,
    /// Greatest slip.
    pub slip_high: f64,
    /// Mean load, N.
    pub load_n: f64,
    /// Half of the spread of the loads, as a share of their mean.
    pub load_share: f64,
}

/// Wheels that go through the stations of a spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct WheelsInTurn {
    /// How many; a divisor of six.
    pub wheels: usize,
    /// How many stations each goes through in turn: all six, or its part of them.
    pub stations_each: usize,
}

/// What one instant at each station of a spread says.
#[derive(Debug, Clone, PartialEq)]
pub struct SpreadInformation([Information; STATIONS]);

impl Spread {
    /// The stations: slips in equal steps.
    pub fn stations(&self) -> [Station; STATIONS] {
        let step = (self.slip_high - self.slip_low) / (STATIONS - 1) as f64;
        std::array::from_fn(|place| Station {
            slip: self.slip_low + place as f64 * step,
            load_n: self.load_n * (1.0 + self.load_share * LOAD_PLACES[place]),
        })
    }

    /// What an instant at each of them says; none where the soil does not carry a load.
    pub fn information(
        &self,
        measurement: &WheelMeasurement,
        wheel: &Wheel<f64>,
        soil: &Soil<f64>,
    ) -> Option<SpreadInformation> {
        let mut all = [Information::none(); STATIONS];
        for (information, station) in all.iter_mut().zip(&self.stations()) {
            *information = measurement.information(wheel, soil, station)?;
        }
        Some(SpreadInformation(all))
    }
}

impl SpreadInformation {
    /// The bound for wheels that go through the stations, all at once, each in `instants` independent instants altogether.
    /// Each wheel has sensors of its own.
    pub fn bound(&self, measurement: &WheelMeasurement, design: WheelsInTurn, instants: f64) -> Option<Bound> {
        let share = instants / design.stations_each as f64;
        let step = STATIONS / design.stations_each;
        let mut seen = vec![(Information::none(), 1.0); design.wheels];
        for (wheel, (sum, _)) in seen.iter_mut().enumerate() {
            for information in self.0.iter().skip(wheel % step).step_by(step) {
                *sum = *sum + *information * share;
            }
        }
        Bound::new(&measurement.beforehand, &seen)
    }
}
