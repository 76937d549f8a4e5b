//! What a drive is: ground, soil, commands, faults.

use kapvik_firmware::rover::{PerSide, PerWheel, Rover};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::WheelState;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::faults::Fault;
use super::ground_soils::Change;
use super::programme::{Command, Programme, Wander};
use super::terrain::{Shape, Terrain};
use crate::prior;

/// A drive, all its details drawn.
#[derive(Debug, Clone)]
pub struct Course {
    /// How long it takes, s.
    pub duration_s: f64,
    /// The ground.
    pub terrain: Terrain,
    /// The soil it begins on.
    pub soil: Soil<f64>,
    /// How the soil changes.
    pub changes: Vec<Change>,
    /// What the drives are told.
    pub programme: Programme,
    /// How far the bogies turn, rad.
    pub bogie_stop_rad: f64,
    /// Sensors that fail.
    pub faults: Vec<Fault>,
}

/// What a soil must be able to do for a drive to be possible.
#[derive(Debug, Clone, Copy)]
pub struct Demand {
    /// Pull over load that each wheel must reach at a slip of [`HARD_SLIP`], all wheels alike.
    pub pull_ratio: f64,
    /// Whether five wheels at a slip of [`EASY_SLIP`] must resist more than one at [`HARD_SLIP`] pulls, so that slips can
    /// spread without any wheel braking.
    pub spread: bool,
    /// Between which slips a rover goes on level ground: there the pull of its wheels vanishes.
    pub level_slip: (f64, f64),
}

impl Default for Demand {
    /// Any pull will do.
    fn default() -> Self {
        Self { pull_ratio: 0.0, spread: false, level_slip: (LEAST_SLIP, HARD_SLIP) }
    }
}

/// How deep a wheel may sink under its share of the weight, over its radius.
const DEEPEST_AT_REST: f64 = 0.45;
/// A rover on the level slips at least as much: on cohesive soils with small K it would brake to go at steady speed, which the
/// equations allow and the networks never saw.
const LEAST_SLIP: f64 = 0.02;
/// A slip at which wheels resist more than they pull.
const EASY_SLIP: f64 = 0.05;
/// A slip at which a rover still makes way.
pub const HARD_SLIP: f64 = 0.6;

/// Pull over load and sinkage over radius of a wheel on level ground that carries its share of the weight.
pub fn pull_ratio(rover: &Rover<f64>, soil: &Soil<f64>, slip: f64) -> Option<(f64, f64)> {
    let load_n = rover.load_at_rest_n();
    let state = WheelState::under_load(&rover.wheel, soil, slip, load_n).ok()?;
    Some((state.drawbar_pull_n / load_n, state.sinkage_m? / rover.wheel.radius_m))
}

/// A soil of the prior that meets a demand.
pub fn draw_soil(random: &mut ChaCha8Rng, rover: &Rover<f64>, demand: &Demand) -> Option<Soil<f64>> {
    const TRIALS: usize = 20_000;
    (0..TRIALS).find_map(|_| {
        let soil = prior::any_soil(|| random.random());
        demand.is_met_by(rover, &soil).then_some(soil)
    })
}

impl Demand {
    fn is_met_by(&self, rover: &Rover<f64>, soil: &Soil<f64>) -> bool {
        let Some((hard, depth)) = pull_ratio(rover, soil, HARD_SLIP) else { return false };
        let pull_at = |slip: f64| pull_ratio(rover, soil, slip).map(|(pull, _)| pull);
        let (least_slip, most_slip) = self.level_slip;
        hard >= self.pull_ratio
            && depth <= DEEPEST_AT_REST
            && pull_at(EASY_SLIP).is_some_and(|easy| !self.spread || 5.0 * easy + hard <= 0.0)
            && pull_at(least_slip).is_some_and(|pull| pull < 0.0)
            && pull_at(most_slip).is_some_and(|pull| pull > 0.0)
    }
}

/// What the hills of a side are drawn from.
#[derive(Debug, Clone, Copy)]
pub struct Hills {
    /// Number of waves.
    pub waves: usize,
    /// How long they are, m.
    pub wavelengths_m: prior::Range,
    /// The slope of the steepest place is drawn from these, rad.
    pub steepest_rad: (f64, f64),
}

/// Hills of a side between two places: sine waves, scaled to the slope of their steepest place.
pub fn draw_hills(random: &mut ChaCha8Rng, between_m: (f64, f64), hills: &Hills) -> Vec<Shape> {
    let mut waves = Vec::new();
    for _ in 0..hills.waves {
        let wavelength_m = hills.wavelengths_m.at(random.random::<f64>());
        // Equal slopes on average, so that the longer waves are the higher.
        let amplitude_m = wavelength_m * random.random_range(0.3..1.0);
        let phase_rad = random.random_range(0.0..std::f64::consts::TAU);
        waves.push((wavelength_m, amplitude_m, phase_rad));
    }
    let shapes = |scale: f64| -> Vec<Shape> {
        let shape = |&(wavelength_m, amplitude_m, phase_rad): &(f64, f64, f64)| Shape::Wave {
            between_m,
            amplitude_m: scale * amplitude_m,
            wavelength_m,
            phase_rad,
        };
        waves.iter().map(shape).collect()
    };
    let wanted = random.random_range(hills.steepest_rad.0..hills.steepest_rad.1);
    shapes(libm::tan(wanted) / steepest_slope(&shapes(1.0), between_m))
}

fn steepest_slope(shapes: &[Shape], between_m: (f64, f64)) -> f64 {
    const PLACES: u32 = 2000;
    let step = (between_m.1 - between_m.0) / f64::from(PLACES);
    let slope = |place: u32| -> f64 {
        let x = between_m.0 + step * f64::from(place);
        shapes.iter().map(|shape| shape.at(x).slope).sum()
    };
    (0..=PLACES).map(slope).fold(1.0e-9, |steepest, slope| steepest.max(slope.abs()))
}

/// Rim speeds that are meant to be equal, and are to one or two percent.
pub fn draw_equal_speeds(random: &mut ChaCha8Rng, rim_speed_m_s: f64) -> PerWheel<f64> {
    PerWheel::<f64>::default().map_wheels(|_| rim_speed_m_s * (1.0 + random.random_range(-0.015..0.015)))
}

/// Rim speeds that let the slips of six wheels spread from about 0.05 to 0.6 on level ground, in an order that is drawn:
/// the slips are spaced so that the pulls at equal loads cancel, as they must at a steady speed.
pub fn draw_spread_speeds(
    random: &mut ChaCha8Rng,
    rover: &Rover<f64>,
    soil: &Soil<f64>,
    fastest_m_s: f64,
) -> PerWheel<f64> {
    let ends = (random.random_range(0.05..0.07), random.random_range(0.55..0.60));
    let slips = |skew: f64| {
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0_f64].map(|place| ends.0 + (ends.1 - ends.0) * libm::pow(place / 5.0, skew))
    };
    let total = |skew: f64| -> f64 {
        slips(skew).iter().map(|slip| pull_ratio(rover, soil, *slip).map_or(0.0, |(ratio, _)| ratio)).sum()
    };
    let (mut low, mut high) = (0.2, 12.0);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        if total(middle) > 0.0 { low = middle } else { high = middle }
    }
    let mut order = slips(low);
    for last in (1..order.len()).rev() {
        order.swap(last, random.random_range(0..=last));
    }
    let hub_speed_m_s = fastest_m_s * (1.0 - ends.1);
    let mut speeds = order.into_iter().map(|slip| hub_speed_m_s / (1.0 - slip));
    PerWheel::<f64>::default().map_wheels(|_| speeds.next().unwrap_or(hub_speed_m_s))
}

/// A programme of commands, with a slow wander of a percent or so.
pub fn draw_programme(random: &mut ChaCha8Rng, commands: Vec<Command>) -> Programme {
    let wander = PerWheel::<Wander>::default().map_wheels(|_| Wander {
        share: random.random_range(0.002..0.012),
        rate_rad_s: std::f64::consts::TAU / random.random_range(8.0..30.0),
        phase_rad: random.random_range(0.0..std::f64::consts::TAU),
    });
    Programme { commands, wander }
}

/// The same shapes on both sides.
pub fn on_both_sides(shapes: Vec<Shape>) -> Terrain {
    Terrain { sides: PerSide::both(shapes), under_one: None }
}
