//! What the sensors of a drive told of the soil, at the best.
//!
//! The bound of Cramér and Rao (van Trees' with the training prior) on the soil under a simulated rover, from the slips,
//! loads, link angles and contacts that it truly had: what its load cells, drives, encoders, velocimeter and accelerometer,
//! with their white noise, say of the soil through the balances of its two sides. The camera and the accelerometer are one
//! each, so that their errors are common to all wheels of a frame. What stands between an estimator and this bound, beside
//! its own faults: the bound knows the shape of the ground and how the links stand, no sensor ever drops out, and it takes
//! each side to carry half of the rover. So none can beat it, and on rough ground none comes near it.

use kapvik_firmware::estimator::STANDING_M_S;
use kapvik_firmware::rover::{Rover, SensorNoise, Side, SideLayout};
use kapvik_firmware::terramechanics::Soil;

use crate::data::truth_file::{Truth, WheelTruth};
use crate::identifiability::beforehand::{Beforehand, Knowledge};
use crate::identifiability::bound::Bound;
use crate::identifiability::information::Information;
use crate::identifiability::rover_side::RoverMeasurement;
use crate::identifiability::sensors::LastingErrors;
use crate::identifiability::steady_drive::{SideBalance, SteadyDrive, SteadyWheel};
use crate::limit::response::respond_exactly;
use crate::simulate::balance::{Instant, WheelInstant, World};

/// What is known beforehand: what the networks were told in training.
const BEFOREHAND: Beforehand =
    Beforehand { targets: Knowledge::Training, pressure: Knowledge::Training, peak: Knowledge::Training };

/// The information gathered so far.
#[derive(Debug, Clone)]
pub struct SoilSeen {
    information: Information,
}

impl Default for SoilSeen {
    fn default() -> Self {
        Self { information: Information::none() }
    }
}

impl SoilSeen {
    /// Takes `frames` frames that are all like this instant.
    pub fn take(&mut self, world: &World, instant: &Instant, truth: &Truth, frames: f64) {
        let rover = &world.rover;
        let speed_m_s = instant.motion.rates.x;
        // One that backs up tells nothing of it either.
        if speed_m_s < STANDING_M_S {
            return;
        }
        // The two errors that all wheels of a frame share are unknowns of that frame, not noise of the wheels' own.
        let measurement = RoverMeasurement {
            sinkage_m: None,
            ground_n: 0.0,
            lasting: LastingErrors {
                speed_scale: rover.noise.velocity_m_s / speed_m_s,
                pitch_rad: rover.noise.accel_m_s2 / rover.gravity_m_s2,
                ..LastingErrors::NONE
            },
            beforehand: BEFOREHAND,
        };
        let noise = SensorNoise { velocity_m_s: 0.0, accel_m_s2: 0.0, ..rover.noise };
        let rover = Rover { noise, ..*rover };
        let soil = world.soils.at(truth.x_m);
        let sides = Side::ALL.as_array().map(|side| {
            let joints = instant.motion.pose.joints(&instant.motion.rates, *side);
            let layout = SideLayout::new(&rover, *side, &joints);
            let instants = instant.wheels.of(*side);
            let balance = SideBalance::at(&rover, &layout, &instants.map(|wheel| wheel.contact), truth.pitch_rad);
            let wheels = truth
                .wheels
                .of(*side)
                .zip(*instants)
                .map(|(wheel, instant)| steady_wheel(&rover, &soil, &wheel, &instant, wheel.soil == truth.soil));
            measurement.information(&rover, &soil, &balance, &SteadyDrive { hub_speed_m_s: speed_m_s, wheels })
        });
        let [Some(left), Some(right)] = sides else { return };
        if let Some(both) = Information::of_instant(&[left, right]) {
            self.information = self.information + both * frames;
        }
    }

    /// The bound.
    pub fn bound(&self) -> Option<Bound> {
        Bound::new(&BEFOREHAND, &[(self.information, 1.0)])
    }
}

/// A wheel as it truly rolls; one that stands, hangs, or is on another soil than the rover says nothing of this one.
fn steady_wheel(
    rover: &Rover<f64>,
    soil: &Soil<f64>,
    truth: &WheelTruth,
    instant: &WheelInstant,
    same: bool,
) -> SteadyWheel {
    let load_n = truth.normal_load_n;
    let rolling = truth.slip.filter(|_| same && load_n > 0.0);
    SteadyWheel {
        slip: truth.slip.unwrap_or(0.0),
        load_n,
        rim_speed_m_s: instant.motion.rim_speed_m_s.abs(),
        response: rolling.and_then(|slip| respond_exactly(&rover.wheel, soil, slip, load_n)),
    }
}
