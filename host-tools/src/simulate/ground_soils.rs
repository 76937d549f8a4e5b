//! Soil that changes along the way.

use kapvik_firmware::rover::{PerSide, Side};
use kapvik_firmware::terramechanics::Soil;

use super::terrain::smooth_step;

/// Over how much of the way one soil gives way to the next, m: about the length of a wheel's contact, in which both lie
/// under the rim.
const BORDER_M: f64 = 0.05;

/// What a soil turns into.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Becomes {
    /// Another soil.
    Soil(Soil<f64>),
    /// The same soil, its grains bound by ice: 3 kPa more cohesion and three times the stiffness.
    IceCemented,
    /// The same soil, loose where ice has sublimated: half of the stiffness.
    Sublimated,
}

impl Becomes {
    fn from(self, before: &Soil<f64>) -> Soil<f64> {
        let stiffer = |factor: f64| Soil {
            cohesive_modulus: factor * before.cohesive_modulus,
            frictional_modulus: factor * before.frictional_modulus,
            ..*before
        };
        match self {
            Self::Soil(soil) => soil,
            Self::IceCemented => Soil { cohesion_pa: before.cohesion_pa + 3.0e3, ..stiffer(3.0) },
            Self::Sublimated => stiffer(0.5),
        }
    }
}

/// A change of soil: each wheel meets it when it gets there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// The distance from which on it has begun, m along x; the rover starts with its differential axis at 0.
    pub from_m: f64,
    /// What the soil before it turns into.
    pub becomes: Becomes,
}

/// The soil along the way, under the wheels of either side.
#[derive(Debug, Clone, PartialEq)]
pub struct SoilsAlongTheWay {
    first: PerSide<Soil<f64>>,
    then: Vec<(f64, PerSide<Soil<f64>>)>,
}

impl SoilsAlongTheWay {
    /// The soils of both sides and their changes, in any order.
    pub fn new(first: PerSide<Soil<f64>>, changes: &[Change]) -> Self {
        let mut changes = changes.to_vec();
        changes.sort_by(|a, b| a.from_m.total_cmp(&b.from_m));
        let mut soils = first;
        let then = changes.iter().map(|change| {
            soils = soils.map(|soil| change.becomes.from(&soil));
            (change.from_m, soils)
        });
        Self { first, then: then.collect() }
    }

    /// The soil under a hub of a side at a distance.
    pub fn under(&self, side: Side, x_m: f64) -> Soil<f64> {
        self.then.iter().fold(*self.first.of(side), |before, (from_m, after)| {
            mixed(&before, after.of(side), smooth_step((x_m - from_m) / BORDER_M).value)
        })
    }

    /// The soil at a distance: where the sides differ, half-way between theirs.
    pub fn at(&self, x_m: f64) -> Soil<f64> {
        mixed(&self.under(Side::Left, x_m), &self.under(Side::Right, x_m), 0.5)
    }
}

/// A soil between two, `share` of the way to the second.
fn mixed(before: &Soil<f64>, after: &Soil<f64>, share: f64) -> Soil<f64> {
    let mix = |part: fn(&Soil<f64>) -> f64| part(before) + share * (part(after) - part(before));
    Soil {
        sinkage_exponent: mix(|soil| soil.sinkage_exponent),
        cohesive_modulus: mix(|soil| soil.cohesive_modulus),
        frictional_modulus: mix(|soil| soil.frictional_modulus),
        cohesion_pa: mix(|soil| soil.cohesion_pa),
        friction_angle_rad: mix(|soil| soil.friction_angle_rad),
        shear_modulus_m: mix(|soil| soil.shear_modulus_m),
        peak_stress_c1: mix(|soil| soil.peak_stress_c1),
        peak_stress_c2: mix(|soil| soil.peak_stress_c2),
        rebound_ratio: mix(|soil| soil.rebound_ratio),
    }
}
