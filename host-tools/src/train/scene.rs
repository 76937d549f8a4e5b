//! Draws of the prior: a rover's wheels on a soil, as they truly are.

use kapvik_firmware::terramechanics::{Soil, Wheel, sinkage_for_load, wheel_forces};
use kapvik_firmware::wheel_state::{Slope, WHEELS, WheelNoise, WheelState};
use rayon::prelude::*;

use super::prior;

/// Wheels of one instant, true to the wheel–soil equations, and how noisily they will be seen.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The geometry that the wheels share.
    pub wheel: Wheel<f64>,
    /// The soil under all of them.
    pub soil: Soil<f64>,
    /// True states; the sinkage is always there.
    pub wheels: heapless::Vec<WheelState, WHEELS>,
    /// Standard deviations of what is seen.
    pub noise: WheelNoise,
    /// Whether the sinkage is seen.
    pub sinkage_seen: bool,
    /// The true slope and how well it is known, where it is seen.
    pub slope: Option<Slope>,
}

impl Scene {
    /// Lets the slope be seen. A rover that drives at steady speed on plane ground pulls itself up it, no more and no
    /// less: its tangent is the total drawbar pull over the total load.
    pub fn with_slope_seen(mut self, std_rad: f64) -> Self {
        let pull: f32 = self.wheels.iter().map(|state| state.drawbar_pull_n).sum();
        let load: f32 = self.wheels.iter().map(|state| state.load_n).sum();
        self.slope = Some(Slope { angle_rad: libm::atan2f(pull, load), std_rad: std_rad as f32 });
        self
    }
}

/// What a set of scenes is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Design {
    /// Mostly Kapvik, some other wheels; mostly six wheels at spread slips, some fewer or alike; all noise levels.
    Training,
    /// Kapvik, six wheels at slips 0.05–0.60, loads within ±8 % of 65.4 N.
    Kapvik {
        /// Independent instants that are averaged.
        instants: u32,
        /// Whether the sinkage is seen.
        sinkage: bool,
    },
}

/// A point of the unit cube, coordinate by coordinate, low in discrepancy (Sobol', Owen-scrambled).
struct Shares {
    index: u32,
    seed: u32,
    dimension: u32,
}

impl Shares {
    /// Points in one Sobol' sequence; later ones start another, scrambled anew.
    const BLOCK: u32 = 1 << 16;

    fn new(index: u32, seed: u32) -> Self {
        let block = index / Self::BLOCK;
        Self { index: index % Self::BLOCK, seed: seed.wrapping_add(block.wrapping_mul(0x9e37_79b9)), dimension: 0 }
    }

    fn next(&mut self) -> f64 {
        let share = sobol_burley::sample(self.index, self.dimension, self.seed);
        self.dimension += 1;
        f64::from(share)
    }
}

/// `count` scenes. The same seed gives the same scenes; draws that the soil cannot carry are left out and replaced.
pub fn scenes(design: Design, count: usize, seed: u32) -> Vec<Scene> {
    let mut scenes = Vec::with_capacity(count);
    let mut next = 0_u32;
    while scenes.len() < count {
        let wanted = (count - scenes.len()) as u32 + 16;
        scenes.par_extend((next..next + wanted).into_par_iter().filter_map(|index| draw(design, index, seed)));
        next += wanted;
    }
    scenes.truncate(count);
    scenes
}

fn draw(design: Design, index: u32, seed: u32) -> Option<Scene> {
    let mut shares = Shares::new(index, seed);
    let soil = draw_soil(&mut shares);
    match design {
        Design::Training => draw_training(&mut shares, soil),
        Design::Kapvik { instants, sinkage } => draw_kapvik(&mut shares, soil, instants, sinkage),
    }
}

fn draw_soil(shares: &mut Shares) -> Soil<f64> {
    Soil {
        cohesion_pa: prior::COHESION_PA.at(shares.next()),
        friction_angle_rad: prior::FRICTION_ANGLE_RAD.at(shares.next()),
        shear_modulus_m: prior::SHEAR_MODULUS_M.at(shares.next()),
        sinkage_exponent: prior::SINKAGE_EXPONENT.at(shares.next()),
        frictional_modulus: prior::STIFFNESS.at(shares.next()),
        cohesive_modulus: 0.0,
        peak_stress_c1: prior::PEAK_STRESS_C1.at(shares.next()),
        peak_stress_c2: prior::PEAK_STRESS_C2.at(shares.next()),
        rebound_ratio: 0.0,
    }
}

fn draw_training(shares: &mut Shares, soil: Soil<f64>) -> Option<Scene> {
    let kapvik = shares.next() < prior::KAPVIK_SHARE;
    let (radius, width, load) = (shares.next(), shares.next(), shares.next());
    let radius_m = prior::RADIUS_M.at(radius);
    let other = Wheel { radius_m, width_m: radius_m * prior::WIDTH_RATIO.at(width) };
    let (wheel, load_n) = if kapvik {
        (prior::KAPVIK_WHEEL, prior::KAPVIK_LOADS_N.at(load))
    } else {
        (other, prior::PRESSURE_PA.at(load) * other.radius_m * other.width_m)
    };
    let spread = prior::LOAD_SPREAD.at(shares.next());
    let slips = Slips::draw(shares);
    let noise = draw_noise(shares, &wheel, load_n);
    let (fewer, count) = (shares.next(), shares.next());
    let count = if fewer < prior::WHOLE_ROVER_SHARE { WHEELS } else { 1 + (count * WHEELS as f64) as usize };
    let sinkage_seen = shares.next() < 0.5;
    let (slope_seen, slope_std) = (shares.next() < 0.7, prior::SLOPE_STD_RAD.at(shares.next()));
    let wheels = (0..count)
        .map(|place| {
            let slip = slips.of(place, count, shares.next());
            let load = load_n * (1.0 + spread * (2.0 * shares.next() - 1.0));
            state(&wheel, &soil, slip, load)
        })
        .collect::<Option<_>>()?;
    let scene = Scene { wheel, soil, wheels, noise, sinkage_seen, slope: None };
    // Only all the wheels of a rover together tell the slope.
    Some(if slope_seen && count == WHEELS { scene.with_slope_seen(slope_std) } else { scene })
}

/// How slip differs among the wheels of an instant.
struct Slips {
    ends: (f64, f64),
    /// One wheel in each of as many equal steps as there are wheels, instead of anywhere between the ends.
    stepped: bool,
}

impl Slips {
    /// Most scenes have wheels driven at deliberately different rim speeds.
    fn draw(shares: &mut Shares) -> Self {
        let (stepped, one, two) = (shares.next() < prior::SPREAD_SHARE, shares.next(), shares.next());
        let (low, high) =
            if stepped { (prior::SPREAD_SLIP_LOW, prior::SPREAD_SLIP_HIGH) } else { (prior::SLIP, prior::SLIP) };
        Self { ends: (low.at(one), high.at(two)), stepped }
    }

    fn of(&self, place: usize, count: usize, share: f64) -> f64 {
        let share = if self.stepped { (place as f64 + share) / count as f64 } else { share };
        self.ends.0 + (self.ends.1 - self.ends.0) * share
    }
}

fn draw_kapvik(shares: &mut Shares, soil: Soil<f64>, instants: u32, sinkage: bool) -> Option<Scene> {
    let wheel = prior::KAPVIK_WHEEL;
    let wheels = (0..WHEELS)
        .map(|place| {
            let slip = 0.05 + 0.55 * place as f64 / (WHEELS - 1) as f64;
            let load = prior::KAPVIK_LOAD_N * (1.0 + 0.08 * (2.0 * shares.next() - 1.0));
            state(&wheel, &soil, slip, load)
        })
        .collect::<Option<_>>()?;
    let noise = noise(&wheel, prior::KAPVIK_LOAD_N, [1.0 / libm::sqrt(f64::from(instants)); 5]);
    Some(Scene { wheel, soil, wheels, noise, sinkage_seen: sinkage, slope: None })
}

/// A true wheel state, or none where the wheel would be stuck.
fn state(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, load_n: f64) -> Option<WheelState> {
    let sinkage_m = sinkage_for_load(wheel, soil, slip, load_n).ok()?;
    let forces = wheel_forces(wheel, soil, slip, sinkage_m).ok()?;
    (sinkage_m <= prior::DEEPEST * wheel.radius_m).then_some(WheelState {
        drawbar_pull_n: forces.drawbar_pull_n as f32,
        load_n: load_n as f32,
        torque_nm: forces.torque_nm as f32,
        slip: slip as f32,
        sinkage_m: Some(sinkage_m as f32),
    })
}

/// Half of the scenes have Kapvik's sensors, averaged over more or fewer instants; half have others.
fn draw_noise(shares: &mut Shares, wheel: &Wheel<f64>, load_n: f64) -> WheelNoise {
    let averaging = prior::AVERAGING.at(shares.next());
    let kapvik = shares.next() < 0.5;
    let factors = [(); 5].map(|()| {
        let other = prior::OTHER_SENSOR.at(shares.next());
        averaging * if kapvik { 1.0 } else { other }
    });
    noise(wheel, load_n, factors)
}

fn noise(wheel: &Wheel<f64>, load_n: f64, factors: [f64; 5]) -> WheelNoise {
    let relative = prior::INSTANT_NOISE;
    let [drawbar_pull, load, torque, slip, sinkage] = factors;
    WheelNoise {
        drawbar_pull_n: (drawbar_pull * relative.drawbar_pull * load_n) as f32,
        load_n: (load * relative.load * load_n) as f32,
        torque_nm: (torque * relative.torque * load_n * wheel.radius_m) as f32,
        slip: (slip * relative.slip) as f32,
        sinkage_m: (sinkage * relative.sinkage * wheel.radius_m) as f32,
    }
}
