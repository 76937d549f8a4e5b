//! The simulated drives that are learned from and those that are held out.

use std::ops::Range;

use indicatif::{ParallelProgressIterator, ProgressBar};
use kapvik_firmware::rover::{Axes, PerSide, Planar, Rover, SensorNoise, Suspension};
use kapvik_firmware::terramechanics::Wheel;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::rows::{Known, Row, SideRows};
use crate::data::rover_file::RoverFile;
use crate::data::sensor_channels::names;
use crate::error::HostError;
use crate::prior;
use crate::simulate::effects::RoverEffects;
use crate::simulate::faults::{Failure, Fault};
use crate::simulate::{Options, Scenario, Traverse};
use crate::train::dataset::stream;
use crate::trial::{WARM_UP_S, flight_pipeline};

/// What the network has to be right on.
pub const NOMINAL: [Scenario; 7] = [
    Scenario::Level,
    Scenario::Spread,
    Scenario::Slope,
    Scenario::Hills,
    Scenario::Rock,
    Scenario::Dropout,
    Scenario::Varied,
];
/// What it has to be right on, too, though less often.
const OTHER: [Scenario; 4] = [Scenario::StartStop, Scenario::SoilChange, Scenario::WheelBlocked, Scenario::WheelLift];

/// The simulation draws from the first two streams of a drive's seed.
const DEVIATION_STREAM: usize = 2;
/// What noises are multiplied by.
const NOISE_FACTORS: prior::Range = prior::Range::logarithmic(1.0 / 6.0, 6.0);
/// How sensors fail, for how long, s, and how long until the next one does.
const FAILURES: [Failure; 4] = [Failure::Nan, Failure::Outlier, Failure::Stuck, Failure::Dropout];
const FAILING_S: Range<f64> = 1.0..6.0;
const WORKING_S: Range<f64> = 2.0..10.0;
/// Kinds of sensors that speak seldom, in one of so many frames; or in none.
const KINDS: [&str; 8] = [
    "load_cell_*",
    "velocity_*",
    "motor_torque_*",
    "wheel_rate_*",
    "gyro_*",
    "accel_*",
    "bogie_angle_*",
    "rocker_angle_rad",
];
const SPEAKS_EVERY: Range<u32> = 2..11;
/// The share of drives with sensors that are silent for good in which it is one column of a frame, not all of a kind; and in which they have
/// been so from the start.
const ONE_COLUMN: f64 = 0.5;
const NEVER_HEARD: f64 = 0.5;
/// Of each other kind there is one drive for so many nominal ones.
const LESS_OFTEN: u32 = 6;
/// No drive is longer, s.
const LONGEST_S: f64 = 120.0;
/// Frames a second.
const RATES_HZ: prior::Range = prior::Range::logarithmic(4.0, 100.0);
/// Other rovers, radii of their wheels, and what the coordinates of their hubs and pivots are multiplied by.
const MASSES_KG: prior::Range = prior::Range::logarithmic(8.0, 900.0);
const RADII_M: prior::Range = prior::Range::logarithmic(0.06, 0.15);
const SHAPE_FACTORS: prior::Range = prior::Range::logarithmic(0.75, 1.35);
/// Where the mass is, forward and up, over the coordinates of the front hub.
const MASS_FORWARD: Range<f64> = -0.15..0.15;
const MASS_UP: Range<f64> = 0.0..0.75;

/// How many drives, and from which seed on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan {
    /// Seed of the first drive; each further drive has the next.
    pub seed: u32,
    /// Drives of each nominal scenario on uneven ground; there are more of plane ones, and fewer of others, but at least one.
    pub drives: u32,
}

/// A drive to be simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Journey {
    scenario: Scenario,
    seed: u64,
    deviation: Deviation,
}

/// In what a drive is not as the flight side assumes. How far is drawn from the seed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Deviation {
    /// In nothing.
    None,
    /// Sensors are better or worse, and the flight side is told.
    Noise,
    /// One sensor after the other fails for seconds.
    Failures,
    /// All sensors of one kind speak in one of several frames.
    Seldom,
    /// One sensor, or all of one kind, say nothing, or nothing any more.
    Silent,
    /// Frames are fewer or more a second.
    Rate,
    /// The rover is lighter or heavier, on wheels and links of other sizes and shapes, and the flight side is told.
    Build,
    /// Links and mass of a rover that is as heavy are elsewhere, and the flight side is told.
    Shape,
    /// Slip digs the wheels in.
    SlipSinkage,
    /// Torque and forces swing as grousers come to bear.
    GrouserRipple,
}

/// All of them but that there is none.
const DEVIATIONS: [Deviation; 9] = [
    Deviation::Noise,
    Deviation::Failures,
    Deviation::Seldom,
    Deviation::Silent,
    Deviation::Rate,
    Deviation::Build,
    Deviation::Shape,
    Deviation::SlipSinkage,
    Deviation::GrouserRipple,
];

/// So many drives of a kind.
#[derive(Debug, Clone, Copy)]
struct Set {
    scenario: Scenario,
    deviation: Deviation,
    drives: u32,
}

/// What drives gave.
#[derive(Debug, Clone, Default)]
pub struct Driven {
    /// Both sides of each drive.
    pub sides: Vec<SideRows>,
    /// How many drives gave them.
    pub drives: usize,
    /// How many were left out: rovers do get stuck.
    pub failed: usize,
}

impl Plan {
    /// What is learned from.
    pub fn training(&self) -> Vec<Journey> {
        numbered(u64::from(self.seed), &self.training_sets())
    }

    /// Of each nominal scenario, in the order of [`NOMINAL`], what is held out: seeds after all that are learned from.
    pub fn held_out(&self) -> [Vec<Journey>; NOMINAL.len()] {
        let learned: u64 = self.training_sets().iter().map(|set| u64::from(set.drives)).sum();
        let mut seed = u64::from(self.seed) + learned;
        NOMINAL.map(|scenario| {
            let journeys = numbered(seed, &[Set { scenario, deviation: Deviation::None, drives: self.less_often() }]);
            seed += journeys.len() as u64;
            journeys
        })
    }

    fn training_sets(&self) -> Vec<Set> {
        let nominal = NOMINAL.map(|scenario| {
            let drives = times_of_nominal(scenario) * self.drives;
            Set { scenario, deviation: Deviation::None, drives }
        });
        let drives = self.less_often();
        let deviations = DEVIATIONS.into_iter().flat_map(|deviation| {
            NOMINAL.map(|scenario| Set { scenario, deviation, drives: deviation.times() * drives })
        });
        let others = OTHER.into_iter().map(|scenario| Set { scenario, deviation: Deviation::None, drives });
        nominal.into_iter().chain(deviations).chain(others).collect()
    }

    fn less_often(&self) -> u32 {
        self.drives.div_ceil(LESS_OFTEN)
    }
}

/// How many times as many drives a nominal scenario has: more on ground that does not curve, where they are shorter, and without which so
/// much uneven ground would make the network doubt plane ground as well.
fn times_of_nominal(scenario: Scenario) -> u32 {
    match scenario {
        Scenario::Level | Scenario::Spread | Scenario::Slope => 2,
        _ => 1,
    }
}

/// The drives of sets, each with a seed of its own.
fn numbered(first: u64, sets: &[Set]) -> Vec<Journey> {
    let kinds = sets.iter().flat_map(|set| (0..set.drives).map(move |_| (set.scenario, set.deviation)));
    (first..).zip(kinds).map(|(seed, (scenario, deviation))| Journey { scenario, seed, deviation }).collect()
}

impl Driven {
    /// Rows of which something is known.
    pub fn known(&self) -> usize {
        self.sides.iter().flatten().filter(|row| row.known.is_some()).count()
    }
}

/// Drives them all; the order of the sides does not hang on the number of cores.
pub fn drive_all(journeys: &[Journey], progress: &ProgressBar) -> Driven {
    progress.set_length(journeys.len() as u64);
    let results: Vec<Result<PerSide<SideRows>, HostError>> =
        journeys.par_iter().progress_with(progress.clone()).map(Journey::sides).collect();
    let mut driven = Driven::default();
    for result in results {
        match result {
            Ok(PerSide { left, right }) => {
                driven.sides.extend([left, right]);
                driven.drives += 1;
            }
            Err(_) => driven.failed += 1,
        }
    }
    driven
}

impl Journey {
    /// Both sides, from the first frame on.
    ///
    /// # Errors
    /// Where the simulation fails.
    fn sides(&self) -> Result<PerSide<SideRows>, HostError> {
        let failed = |why: String| self.scenario.failed(self.seed, why);
        let (rover, options) = self.deviation.draw(&mut stream(self.seed, DEVIATION_STREAM)).map_err(failed)?;
        let traverse = Traverse::new(self.scenario, self.seed, &rover, &options);
        let mut pipeline = flight_pipeline(&rover).map_err(failed)?;
        let mut sides = PerSide::<SideRows>::default();
        for step in traverse.map_err(|error| failed(error.to_string()))? {
            let (frame, truth) = step.map_err(|error| failed(error.to_string()))?;
            pipeline.tick(&frame);
            let estimator = pipeline.estimator();
            let Some(believed) = estimator.believed() else { continue };
            let counts = frame.time_us as f64 * 1.0e-6 >= WARM_UP_S;
            let seen = believed.as_ref().zip(estimator.estimate().as_ref()).zip(truth.wheels.as_ref());
            let PerSide { left, right } = sides.as_mut().zip(seen);
            for (rows, ((believed, estimate), truth)) in [left, right] {
                if let Some(inputs) = &believed.inputs {
                    let known = counts.then(|| Known::new(believed, estimate, truth)).flatten();
                    rows.push(Row { known, ..Row::new(inputs) });
                }
            }
        }
        Ok(sides)
    }
}

impl Deviation {
    /// How many times as many drives it has: links that swing with the grousers are hardest to tell from ground, no input is how often frames
    /// come, and sensors that may be silent, noises and lengths are many.
    fn times(self) -> u32 {
        if matches!(self, Self::SlipSinkage | Self::Failures | Self::Seldom) { 1 } else { 2 }
    }

    /// The rover, and what acts on it.
    fn draw(self, random: &mut ChaCha8Rng) -> Result<(Rover<f64>, Options), String> {
        let mut rover = RoverFile::assumed().rover;
        let mut effects = RoverEffects::default();
        let mut faults = Vec::new();
        let mut rate_hz = None;
        let only = |id, value| RoverEffects::only(id, value).map_err(|error| error.to_string());
        match self {
            Self::None => {}
            Self::Noise => rover.noise = other_noise(&rover.noise, random),
            Self::Failures => faults = failures(random)?,
            Self::Seldom => faults = silences(random)?,
            Self::Silent => faults.push(silence(random)?),
            Self::Rate => rate_hz = Some(RATES_HZ.at(random.random())),
            Self::Build => rover = other_shape(&other_build(&rover, random), random),
            Self::Shape => rover = other_shape(&rover, random),
            Self::SlipSinkage => effects = only("slip-sinkage", random.random_range(0.0..0.3))?,
            Self::GrouserRipple => effects = only("grouser-ripple", random.random_range(0.0..0.25))?,
        }
        Ok((rover, Options { rate_hz, effects, faults, ..Options::default() }))
    }
}

/// One sensor at a time fails, in one of its columns.
fn failures(random: &mut ChaCha8Rng) -> Result<Vec<Fault>, String> {
    let columns = names();
    let mut failures = Vec::new();
    let mut start_s = WARM_UP_S;
    while start_s < LONGEST_S {
        let column = &columns[random.random_range(0..columns.len())];
        let failure = FAILURES[random.random_range(0..FAILURES.len())];
        let end_s = start_s + random.random_range(FAILING_S);
        failures.push(Fault::new(failure, column, (start_s, end_s))?);
        start_s = end_s + random.random_range(WORKING_S);
    }
    Ok(failures)
}

/// All sensors of a kind are silent but in one of so many frames.
fn silences(random: &mut ChaCha8Rng) -> Result<Vec<Fault>, String> {
    let columns = KINDS[random.random_range(0..KINDS.len())];
    Fault::silent_but_one_in(random.random_range(SPEAKS_EVERY), columns, LONGEST_S)
}

/// One column, or those of a kind, is silent for good: always, or from some time on.
fn silence(random: &mut ChaCha8Rng) -> Result<Fault, String> {
    let names = names();
    let columns = if random.random::<f64>() < ONE_COLUMN {
        names[random.random_range(0..names.len())].as_str()
    } else {
        KINDS[random.random_range(0..KINDS.len())]
    };
    let never_heard = random.random::<f64>() < NEVER_HEARD;
    let from_s = if never_heard { 0.0 } else { random.random_range(WARM_UP_S..LONGEST_S / 2.0) };
    Fault::new(Failure::Dropout, columns, (from_s, LONGEST_S))
}

/// Another mass on wheels of another size. The links grow with the wheels, by anything from not at all to as much as they do.
fn other_build(rover: &Rover<f64>, random: &mut ChaCha8Rng) -> Rover<f64> {
    let radius_m = RADII_M.at(random.random());
    let larger = (radius_m / rover.wheel.radius_m).powf(random.random());
    let link = |place: Planar<f64>| place.scaled(larger);
    let Suspension { front_hub, bogie_pivot, middle_hub, rear_hub, half_track_m, centre_of_mass } = rover.suspension;
    Rover {
        mass_kg: MASSES_KG.at(random.random()),
        wheel: Wheel { radius_m, width_m: radius_m },
        suspension: Suspension {
            front_hub: link(front_hub),
            bogie_pivot: link(bogie_pivot),
            middle_hub: link(middle_hub),
            rear_hub: link(rear_hub),
            half_track_m: larger * half_track_m,
            centre_of_mass: centre_of_mass.map(|place| larger * place),
        },
        ..*rover
    }
}

/// Each length by itself is shorter or longer, and the mass elsewhere.
fn other_shape(rover: &Rover<f64>, random: &mut ChaCha8Rng) -> Rover<f64> {
    let Suspension { front_hub, bogie_pivot, middle_hub, rear_hub, half_track_m, .. } = rover.suspension;
    let mut other = |length_m: f64| length_m * SHAPE_FACTORS.at(random.random());
    let [front_hub, bogie_pivot, middle_hub, rear_hub] =
        [front_hub, bogie_pivot, middle_hub, rear_hub].map(|place| Planar { x: other(place.x), z: other(place.z) });
    let half_track_m = other(half_track_m);
    let centre_of_mass = Axes {
        x: front_hub.x * random.random_range(MASS_FORWARD),
        y: 0.0,
        z: -front_hub.z * random.random_range(MASS_UP),
    };
    let suspension = Suspension { front_hub, bogie_pivot, middle_hub, rear_hub, half_track_m, centre_of_mass };
    Rover { suspension, ..*rover }
}

/// Each noise by itself is better or worse.
fn other_noise(noise: &SensorNoise<f64>, random: &mut ChaCha8Rng) -> SensorNoise<f64> {
    let mut other = |std: f64| std * NOISE_FACTORS.at(random.random());
    SensorNoise {
        wheel_rate_rad_s: other(noise.wheel_rate_rad_s),
        motor_torque_nm: other(noise.motor_torque_nm),
        load_cell_n: other(noise.load_cell_n),
        angle_rad: other(noise.angle_rad),
        accel_m_s2: other(noise.accel_m_s2),
        gyro_rad_s: other(noise.gyro_rad_s),
        velocity_m_s: other(noise.velocity_m_s),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn no_two_drives_have_the_same_seed() {
        let plan = Plan { seed: 20_000, drives: 16 };
        let training = plan.training();
        assert_eq!(training.len(), 3 * 32 + 4 * 16 + 7 * (3 + 6 * 2) * 3 + 4 * 3);
        let held_out = plan.held_out();
        assert!(held_out.iter().all(|journeys| journeys.len() == 3));
        let seeds: BTreeSet<u64> = training.iter().chain(held_out.iter().flatten()).map(|drive| drive.seed).collect();
        assert_eq!(seeds.len(), training.len() + 7 * 3);
        assert_eq!(seeds.first(), Some(&20_000));
        assert!(Plan { seed: 0, drives: 1 }.held_out().iter().all(|journeys| journeys.len() == 1));
    }

    #[test]
    fn a_drive_that_deviates_gives_the_same_rows_again() {
        for deviation in DEVIATIONS.into_iter().chain([Deviation::None]) {
            let journey = Journey { scenario: Scenario::Level, seed: 3, deviation };
            let sides = journey.sides().expect("a drive on the level");
            let known = sides.as_ref().map(|rows| rows.iter().filter(|row| row.known.is_some()).count());
            assert!(known.left > 200 && known.right > 200, "{deviation:?}: {known:?} rows");
            assert!(sides == journey.sides().expect("the same drive"), "{deviation:?}");
        }
    }
}
