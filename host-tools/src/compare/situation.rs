//! The situations in which the methods are set side by side.

use kapvik_firmware::terramechanics::Soil;

use crate::train::prior;

/// What is asked of every method, many times over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Situation {
    /// Short name.
    pub id: &'static str,
    /// In words.
    pub title: &'static str,
    /// What is true.
    pub truth: Truth,
    /// Half of the spread of the wheels' loads, as a share of their mean.
    pub load_spread: f64,
    /// Independent instants that are averaged.
    pub instants: u32,
    /// Slip-sinkage in the soil.
    pub slip_sinkage: SlipSinkage,
}

/// Which soil is under the wheels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Truth {
    /// One drawn for each case from the prior that the networks were trained with. Methods that take a prior are told it.
    Drawn,
    /// The same in all cases. Methods that take a prior have the usual one.
    Fixed(Soil<f64>),
}

/// Slip-sinkage that equations 1–11 lack: n = n₀ + n₁ i, n₁ drawn from 0 … 0.7.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SlipSinkage {
    /// There is none.
    None,
    /// There is, and nobody says so.
    Undeclared,
    /// There is, and methods that take effects are told.
    Declared,
}

/// The greatest n₁.
pub const GREATEST_SLIP_SINKAGE: f64 = 0.7;
/// Slip of the first and of the last of the six wheels; those between lie in equal steps.
pub const SLIPS: [f64; 2] = [0.05, 0.60];

/// The seed's Table 1: near the middle of the usual prior.
const NEAR: Truth = Truth::Fixed(TABLE_1);
/// Table 1 with c = 1.5 kPa, φ = 25° and K = 22 mm: one to two standard deviations of the usual prior away in each.
const FAR: Truth =
    Truth::Fixed(Soil { cohesion_pa: 1500.0, friction_angle_rad: 25.0 * DEGREE, shear_modulus_m: 0.022, ..TABLE_1 });
const DEGREE: f64 = std::f64::consts::PI / 180.0;
const TABLE_1: Soil<f64> = Soil {
    sinkage_exponent: 1.1,
    cohesive_modulus: 0.0,
    // k_c/b + k_φ on Kapvik's wheel.
    frictional_modulus: 15.6e3 / prior::KAPVIK_WHEEL.width_m + 2407.4e3,
    cohesion_pa: 250.0,
    friction_angle_rad: 31.9 * DEGREE,
    shear_modulus_m: 0.0114,
    peak_stress_c1: 0.18,
    peak_stress_c2: 0.32,
    rebound_ratio: 0.0,
};

const fn plain(id: &'static str, title: &'static str, truth: Truth, load_spread: f64, instants: u32) -> Situation {
    Situation { id, title, truth, load_spread, instants, slip_sinkage: SlipSinkage::None }
}

/// All of them, in the order of the table.
pub const SITUATIONS: [Situation; 18] = [
    plain("drawn-equal-1", "soil drawn from the prior, equal loads, one instant", Truth::Drawn, 0.0, 1),
    plain("drawn-equal-100", "soil drawn from the prior, equal loads, mean of 100", Truth::Drawn, 0.0, 100),
    plain("drawn-spread-1", "soil drawn from the prior, loads ±50 %, one instant", Truth::Drawn, 0.5, 1),
    plain("drawn-spread-100", "soil drawn from the prior, loads ±50 %, mean of 100", Truth::Drawn, 0.5, 100),
    plain("near-equal-1", "Table 1, equal loads, one instant", NEAR, 0.0, 1),
    plain("near-equal-100", "Table 1, equal loads, mean of 100", NEAR, 0.0, 100),
    plain("near-8-1", "Table 1, loads ±8 %, one instant", NEAR, 0.08, 1),
    plain("near-8-100", "Table 1, loads ±8 %, mean of 100", NEAR, 0.08, 100),
    plain("near-spread-1", "Table 1, loads ±50 %, one instant", NEAR, 0.5, 1),
    plain("near-spread-100", "Table 1, loads ±50 %, mean of 100", NEAR, 0.5, 100),
    plain("far-equal-1", "c 1.5 kPa, φ 25°, K 22 mm, equal loads, one instant", FAR, 0.0, 1),
    plain("far-equal-100", "c 1.5 kPa, φ 25°, K 22 mm, equal loads, mean of 100", FAR, 0.0, 100),
    plain("far-spread-1", "c 1.5 kPa, φ 25°, K 22 mm, loads ±50 %, one instant", FAR, 0.5, 1),
    plain("far-spread-100", "c 1.5 kPa, φ 25°, K 22 mm, loads ±50 %, mean of 100", FAR, 0.5, 100),
    Situation {
        slip_sinkage: SlipSinkage::Undeclared,
        ..plain("undeclared-1", "slip-sinkage that nobody declares, loads ±50 %, one instant", Truth::Drawn, 0.5, 1)
    },
    Situation {
        slip_sinkage: SlipSinkage::Undeclared,
        ..plain("undeclared-100", "slip-sinkage that nobody declares, loads ±50 %, mean of 100", Truth::Drawn, 0.5, 100)
    },
    Situation {
        slip_sinkage: SlipSinkage::Declared,
        ..plain("declared-1", "slip-sinkage that is declared, loads ±50 %, one instant", Truth::Drawn, 0.5, 1)
    },
    Situation {
        slip_sinkage: SlipSinkage::Declared,
        ..plain("declared-100", "slip-sinkage that is declared, loads ±50 %, mean of 100", Truth::Drawn, 0.5, 100)
    },
];

impl Situation {
    /// The situation of that name.
    pub fn find(id: &str) -> Option<&'static Self> {
        SITUATIONS.iter().find(|situation| situation.id == id)
    }

    /// Whether equations 1–11, with the effects declared, are what made the data.
    pub fn model_is_right(&self) -> bool {
        self.slip_sinkage != SlipSinkage::Undeclared
    }
}
