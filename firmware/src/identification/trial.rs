//! Six wheels at one instant on which the cost of the methods is counted, and on which they give the same bits everywhere.

use crate::fingerprint::{Digest, SOILS};
use crate::terramechanics::{Soil, Wheel};
use crate::wheel_state::{WheelNoise, WheelState};

use super::ding::{DingBounds, ding};
use super::hutangkabodee::hutangkabodee;
use super::iagnemma::{IagnemmaAssumptions, Recursive, iagnemma};
use super::ray::ray;
use super::{Assumed, Identified, Observation, Refusal, SoilPrior, map};

/// What six wheels read at one instant.
pub type SixWheels = [Observation<f32>; 6];

/// A method as it is called on six wheels.
#[derive(Debug, Clone, Copy)]
pub struct Method {
    /// Its name.
    pub name: &'static str,
    /// What it says of the soil.
    pub call: fn(&SixWheels) -> Result<Identified<f32>, Refusal>,
}

/// The methods of the literature. What they take as given is that of the first soil of [`SOILS`].
pub const LITERATURE: [Method; 4] = [
    Method { name: "iagnemma", call: |seen| iagnemma(&WHEEL, seen, &modulus_given()) },
    Method { name: "ding", call: |seen| ding(&WHEEL, seen, &DingBounds::usual()) },
    Method { name: "hutangkabodee", call: |seen| hutangkabodee(&WHEEL, seen, &SAND) },
    Method { name: "ray_16_soils", call: |seen| ray(&WHEEL, seen, &bank()) },
];

/// Recursive least squares, a wheel after the other.
pub const ONE_BY_ONE: Method = Method {
    name: "iagnemma_update",
    call: |seen| {
        let mut line = recursive()?;
        seen.iter().try_for_each(|one| line.add(&WHEEL, one))?;
        line.identified()
    },
};

/// The maximum a posteriori, with room for six wheels.
pub const MAP: Method = Method {
    name: "map",
    call: |seen| map::identify_up_to::<6, f32>(&WHEEL, seen, &SoilPrior::usual()).map(|found| found.identified),
};

impl Method {
    /// Checksum of what it says of the soils of [`SOILS`], with one torque somewhat off to either side.
    pub fn fingerprint(&self) -> u32 {
        let mut digest = Digest::new();
        for soil in &SOILS {
            let Some(seen) = six_wheels(soil) else {
                digest.add(f32::NAN);
                continue;
            };
            for off in [-0.7, 0.4] {
                match (self.call)(&with_error(&seen, off)) {
                    Ok(found) => digest.add_all(numbers(&found)),
                    Err(_) => digest.add(f32::NAN),
                }
            }
        }
        digest.finish()
    }
}

fn numbers(found: &Identified<f32>) -> [f32; 7] {
    let [c, phi, k] = [found.cohesion_pa, found.friction_angle_rad, found.shear_modulus_m];
    let std = |std: Option<f32>| std.unwrap_or(f32::NAN);
    [c.value, std(c.std), phi.value, std(phi.std), k.value, std(k.std), found.condition_number]
}

const SAND: Soil<f32> = {
    let [sand, ..] = SOILS;
    sand
};

fn modulus_given() -> IagnemmaAssumptions<f32> {
    let shear_modulus_m = Assumed { value: SAND.shear_modulus_m, std: 0.003 };
    IagnemmaAssumptions { shear_modulus_m, cohesion_pa: None }
}

/// Recursive least squares at its start.
///
/// # Errors
/// None with what is given here.
pub fn recursive() -> Result<Recursive<f32>, Refusal> {
    Recursive::new(&modulus_given(), 0.98)
}

/// Soils that the multiple models choose from: the cost grows in proportion.
const BANK: usize = 16;

fn bank() -> [Soil<f32>; BANK] {
    core::array::from_fn(|place| {
        let share = place as f32 / BANK as f32;
        Soil { friction_angle_rad: 0.35 + 0.4 * share, shear_modulus_m: 0.02 - 0.01 * share, ..SAND }
    })
}

/// Kapvik's, as it is assumed.
pub const WHEEL: Wheel<f32> = Wheel { radius_m: 0.075, width_m: 0.07 };
/// Of one instant.
const NOISE: WheelNoise<f32> =
    WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.05, slip: 0.01, sinkage_m: 0.002 };
/// Slip and load (N) of each wheel.
const WHEELS: [(f32, f32); 6] = [(0.05, 45.0), (0.16, 80.0), (0.27, 55.0), (0.38, 90.0), (0.49, 65.0), (0.60, 50.0)];

/// What faultless sensors read on a soil that carries the wheels.
pub fn six_wheels(soil: &Soil<f32>) -> Option<SixWheels> {
    let nothing = WheelState { drawbar_pull_n: 0.0, load_n: 0.0, torque_nm: 0.0, slip: 0.0, sinkage_m: None };
    let mut seen = [Observation { state: nothing, noise: NOISE }; 6];
    for (observation, (slip, load_n)) in seen.iter_mut().zip(WHEELS) {
        observation.state = WheelState::under_load(&WHEEL, soil, slip, load_n).ok()?;
    }
    Some(seen)
}

/// The same with the first wheel's torque `off` standard deviations off, so that no two calls are alike.
pub fn with_error(seen: &SixWheels, off: f32) -> SixWheels {
    let mut seen = *seen;
    seen.iter_mut().take(1).for_each(|first| first.state.torque_nm += off * NOISE.torque_nm);
    seen
}
