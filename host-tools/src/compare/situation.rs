//! The situations in which the methods are set side by side.

use kapvik_firmware::terramechanics::Soil;

use crate::prior::KAPVIK_WHEEL;
use crate::soil_catalogue::TABLE_1;

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

/// Which soil is under the wheels. Methods that take a prior are told the one that the networks were trained with, whatever
/// is true; `map` also stands in the table with the usual one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Truth {
    /// One drawn for each case from the prior that the networks were trained with.
    Drawn,
    /// One drawn for each case as far from the middle of the usual prior: ln c, φ and ln K each by a number of standard
    /// deviations between these, to either side; all else as in [`Self::Drawn`].
    Off {
        /// Least distance.
        from: f64,
        /// Greatest distance.
        to: f64,
    },
    /// The same in all cases. It shows spread and bias, but ranks no methods: who says the same of any soil may be right.
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

const NEAR: Truth = Truth::Off { from: 0.0, to: 1.0 };
const FAR: Truth = Truth::Off { from: 1.0, to: 2.0 };
/// The seed's Table 1, of which an independent implementation has figures.
const FIXED: Truth = Truth::Fixed(TABLE_1_UNDER_KAPVIK);
/// Far from what is usual, with figures of the same implementation.
const FIXED_FAR: Truth = Truth::Fixed(Soil {
    cohesion_pa: 1500.0,
    friction_angle_rad: 25.0 * DEGREE,
    shear_modulus_m: 0.022,
    ..TABLE_1_UNDER_KAPVIK
});
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// With one modulus, k_c/b + k_φ on Kapvik's wheel.
const TABLE_1_UNDER_KAPVIK: Soil<f64> = Soil {
    cohesive_modulus: 0.0,
    frictional_modulus: TABLE_1.cohesive_modulus / KAPVIK_WHEEL.width_m + TABLE_1.frictional_modulus,
    ..TABLE_1
};

const fn plain(id: &'static str, title: &'static str, truth: Truth, load_spread: f64, instants: u32) -> Situation {
    Situation { id, title, truth, load_spread, instants, slip_sinkage: SlipSinkage::None }
}

/// All of them, in the order of the table.
pub const SITUATIONS: [Situation; 22] = [
    plain("drawn-equal-1", "soil drawn from the prior, equal loads, one instant", Truth::Drawn, 0.0, 1),
    plain("drawn-equal-100", "soil drawn from the prior, equal loads, mean of 100", Truth::Drawn, 0.0, 100),
    plain("drawn-spread-1", "soil drawn from the prior, loads ±50 %, one instant", Truth::Drawn, 0.5, 1),
    plain("drawn-spread-100", "soil drawn from the prior, loads ±50 %, mean of 100", Truth::Drawn, 0.5, 100),
    plain("near-equal-1", "soil near what is usual, equal loads, one instant", NEAR, 0.0, 1),
    plain("near-equal-100", "soil near what is usual, equal loads, mean of 100", NEAR, 0.0, 100),
    plain("near-spread-1", "soil near what is usual, loads ±50 %, one instant", NEAR, 0.5, 1),
    plain("near-spread-100", "soil near what is usual, loads ±50 %, mean of 100", NEAR, 0.5, 100),
    plain("far-equal-1", "soil far from what is usual, equal loads, one instant", FAR, 0.0, 1),
    plain("far-equal-100", "soil far from what is usual, equal loads, mean of 100", FAR, 0.0, 100),
    plain("far-spread-1", "soil far from what is usual, loads ±50 %, one instant", FAR, 0.5, 1),
    plain("far-spread-100", "soil far from what is usual, loads ±50 %, mean of 100", FAR, 0.5, 100),
    plain("table1-8-1", "the soil of Table 1, loads ±8 %, one instant", FIXED, 0.08, 1),
    plain("table1-8-100", "the soil of Table 1, loads ±8 %, mean of 100", FIXED, 0.08, 100),
    plain("table1-spread-1", "the soil of Table 1, loads ±50 %, one instant", FIXED, 0.5, 1),
    plain("table1-spread-100", "the soil of Table 1, loads ±50 %, mean of 100", FIXED, 0.5, 100),
    plain("weak-spread-1", "c 1.5 kPa, φ 25°, K 22 mm, loads ±50 %, one instant", FIXED_FAR, 0.5, 1),
    plain("weak-spread-100", "c 1.5 kPa, φ 25°, K 22 mm, loads ±50 %, mean of 100", FIXED_FAR, 0.5, 100),
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

    /// Whether equations 1–11 alone are.
    pub fn obeys_equations(&self) -> bool {
        self.slip_sinkage == SlipSinkage::None
    }

    /// Whether the soil differs from case to case, so that nobody is right by saying always the same.
    pub fn soils_differ(&self) -> bool {
        !matches!(self.truth, Truth::Fixed(_))
    }
}
