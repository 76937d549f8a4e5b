//! The stated priors: what a soil, a wheel and a set of sensors may be, before any data.
//!
//! The soil ranges and the noise are those of the experiment that `kapvik bench network` and `limit` judge by (φ 22–42°, K
//! 5–35 mm, n 0.8–1.3, k_φ 0.8–5 MPa/mⁿ, 0.5 N, 1 N, 0.05 N·m, 2 mm and 0.01 per instant on the assumed Kapvik wheel).

use kapvik_firmware::soil::LEAST_SLIP;
use kapvik_firmware::terramechanics::effects::Grousers;
use kapvik_firmware::terramechanics::{Soil, Wheel};
use kapvik_firmware::wheel_state::WheelNoise;

/// A range, and how a number lies in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Least value.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
    /// Uniform in the logarithm instead of in the number.
    pub logarithmic: bool,
}

impl Range {
    const fn linear(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: false }
    }

    /// Uniform in the logarithm.
    pub const fn logarithmic(low: f64, high: f64) -> Self {
        Self { low, high, logarithmic: true }
    }

    /// The value at a share 0 … 1 of the range.
    pub fn at(&self, share: f64) -> f64 {
        if self.logarithmic {
            self.low * libm::pow(self.high / self.low, share)
        } else {
            self.low + (self.high - self.low) * share
        }
    }

    /// The share 0 … 1 of the range at which a value lies; the inverse of [`Self::at`].
    pub fn share(&self, value: f64) -> f64 {
        if self.logarithmic {
            libm::log(value / self.low) / libm::log(self.high / self.low)
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }
}

/// Cohesion c, Pa.
pub const COHESION_PA: Range = Range::logarithmic(50.0, 3000.0);
/// Friction angle φ, rad: 22 … 42°.
pub const FRICTION_ANGLE_RAD: Range = Range::linear(0.383_972_435_438_752_5, 0.733_038_285_837_618_4);
/// Shear deformation modulus K, m.
pub const SHEAR_MODULUS_M: Range = Range::logarithmic(0.005, 0.035);
/// Sinkage exponent n.
pub const SINKAGE_EXPONENT: Range = Range::linear(0.8, 1.3);
/// Stiffness k_c/b + k_φ, Pa/mⁿ.
pub const STIFFNESS: Range = Range::logarithmic(0.8e6, 5.0e6);
/// Peak-stress position c₁.
pub const PEAK_STRESS_C1: Range = Range::linear(0.15, 0.50);
/// Peak-stress shift c₂.
pub const PEAK_STRESS_C2: Range = Range::linear(0.0, 0.35);

/// Parameters of a soil that are drawn.
pub const SOIL_PARAMETERS: usize = 7;
/// Their ranges: c, φ, K, n, stiffness, c₁, c₂.
pub const SOIL_RANGES: [Range; SOIL_PARAMETERS] =
    [COHESION_PA, FRICTION_ANGLE_RAD, SHEAR_MODULUS_M, SINKAGE_EXPONENT, STIFFNESS, PEAK_STRESS_C1, PEAK_STRESS_C2];

/// The soil of these parameters, in the order and the units of [`SOIL_RANGES`].
pub fn soil(parameters: [f64; SOIL_PARAMETERS]) -> Soil<f64> {
    let [cohesion_pa, friction_angle_rad, shear_modulus_m, sinkage_exponent, stiffness, c1, c2] = parameters;
    Soil {
        cohesion_pa,
        friction_angle_rad,
        shear_modulus_m,
        sinkage_exponent,
        frictional_modulus: stiffness,
        cohesive_modulus: 0.0,
        peak_stress_c1: c1,
        peak_stress_c2: c2,
        rebound_ratio: 0.0,
    }
}

/// The soil whose parameters lie at these shares 0 … 1 of their ranges.
pub fn soil_at(shares: [f64; SOIL_PARAMETERS]) -> Soil<f64> {
    soil(std::array::from_fn(|parameter| SOIL_RANGES[parameter].at(shares[parameter])))
}

/// A soil of the prior; `share` gives numbers 0 … 1, one a parameter.
pub fn any_soil(mut share: impl FnMut() -> f64) -> Soil<f64> {
    soil_at([(); SOIL_PARAMETERS].map(|()| share()))
}

/// A soil whose parameters lie in these ranges, in the order and the units of [`SOIL_RANGES`].
pub fn any_soil_within(ranges: &[Range; SOIL_PARAMETERS], mut share: impl FnMut() -> f64) -> Soil<f64> {
    soil(ranges.map(|range| range.at(share())))
}

/// Share of scenes with Kapvik's wheel.
pub const KAPVIK_SHARE: f64 = 0.75;
/// Share of scenes that surely have all six wheels; the others have one to six.
pub const WHOLE_ROVER_SHARE: f64 = 0.8;
/// Share of scenes whose wheels are driven at deliberately different rim speeds.
pub const SPREAD_SHARE: f64 = 0.8;

/// Share of the scenes for the rover network's training in which Kapvik drives its six wheels at slips from small to great: what
/// makes a soil observable, and what asks most of a network. What it is judged and its intervals are calibrated on is the rest.
pub const MANOEUVRE_SHARE: f64 = 0.65;
/// Mean load of the wheels there, N.
pub const MANOEUVRE_LOADS_N: Range = Range::linear(50.0, 80.0);
/// Half of the spread of load among the wheels there, as a share of the mean: great spreads tell most, and ask most.
pub const MANOEUVRE_LOAD_SPREAD: Range = Range::linear(0.03, 0.6);
/// Least slip there.
pub const MANOEUVRE_SLIP_LOW: Range = Range::linear(LEAST_SLIP, 0.10);
/// Greatest slip there.
pub const MANOEUVRE_SLIP_HIGH: Range = Range::linear(0.50, 0.70);

/// Share of the scenes for the rover network's training in which the ground is patchy: several soils under the wheels, of which
/// the mean is to be told. What it is judged and its intervals are calibrated on is one soil.
pub const PATCHY_SHARE: f64 = 0.1;
/// How far a parameter of a patch may be from the middle of its scene, as a share of its range.
pub const PATCH_REACH: Range = Range::linear(0.0, 0.25);

/// Kapvik's wheel. Assumed, not published (assumption set K0).
pub const KAPVIK_WHEEL: Wheel<f64> = Wheel { radius_m: 0.075, width_m: 0.070 };
/// Kapvik's grousers. Assumed, not published (assumption set K0). They act only through an effect.
pub const KAPVIK_GROUSERS: Grousers<f64> = Grousers { height_m: 0.005, count: 24.0 };
/// Mean load of Kapvik's wheels in that experiment, N; 40 kg on six wheels.
pub const KAPVIK_LOAD_N: f64 = 65.4;
/// Half of the spread of true loads among the wheels there, as a share of their mean.
pub const KAPVIK_LOAD_SPREAD: f64 = 0.08;
/// Mean load of Kapvik's wheels in training, N.
pub const KAPVIK_LOADS_N: Range = Range::linear(30.0, 110.0);
/// Radius of other wheels, m.
pub const RADIUS_M: Range = Range::logarithmic(0.045, 0.20);
/// Width over radius of other wheels.
pub const WIDTH_RATIO: Range = Range::linear(0.5, 1.3);
/// Mean of W/(rb) of other wheels, Pa.
pub const PRESSURE_PA: Range = Range::logarithmic(2.2e3, 2.2e4);
/// Half of the spread of load among the wheels of an instant, as a share of the mean.
pub const LOAD_SPREAD: Range = Range::logarithmic(0.03, 0.6);
/// Slip of a wheel.
pub const SLIP: Range = Range::linear(LEAST_SLIP, 0.70);
/// Least slip among wheels that are driven at deliberately different rim speeds.
pub const SPREAD_SLIP_LOW: Range = Range::linear(LEAST_SLIP, 0.15);
/// Greatest slip among wheels that are driven at deliberately different rim speeds.
pub const SPREAD_SLIP_HIGH: Range = Range::linear(0.45, 0.70);
/// Deepest sinkage over radius that is kept; deeper wheels are stuck.
pub const DEEPEST: f64 = 0.6;

/// One standard deviation per instant on Kapvik's wheel.
pub const KAPVIK_INSTANT_NOISE: WheelNoise<f64> =
    WheelNoise { drawbar_pull_n: 0.5, load_n: 1.0, torque_nm: 0.05, slip: 0.01, sinkage_m: 0.002 };
/// The same over the mean load (DP, W), over load and radius (T), of slip, and over radius (z).
pub const INSTANT_NOISE: RelativeNoise = RelativeNoise {
    drawbar_pull: KAPVIK_INSTANT_NOISE.drawbar_pull_n / KAPVIK_LOAD_N,
    load: KAPVIK_INSTANT_NOISE.load_n / KAPVIK_LOAD_N,
    torque: KAPVIK_INSTANT_NOISE.torque_nm / (KAPVIK_LOAD_N * KAPVIK_WHEEL.radius_m),
    slip: KAPVIK_INSTANT_NOISE.slip,
    sinkage: KAPVIK_INSTANT_NOISE.sinkage_m / KAPVIK_WHEEL.radius_m,
};
/// Factor on the noise of all channels: a mean of 400 instants … one instant.
pub const AVERAGING: Range = Range::logarithmic(0.05, 1.0);
/// Share of what the rover network is shown in a pass that Kapvik's sensors see, over as many instants as
/// [`PRECISE_AVERAGING`] says: precise states ask most of a network, and are few without it. What a soil may be stays as it
/// is, and so do the scenes that networks are judged and their intervals calibrated on.
pub const PRECISE_SHARE: f64 = 0.65;
/// Factor on the noise of all channels there: a mean of 400 … 25 instants.
pub const PRECISE_AVERAGING: Range = Range::logarithmic(0.05, 0.2);
/// Further factor on the noise of a single channel, for other sensors than Kapvik's.
pub const OTHER_SENSOR: Range = Range::logarithmic(0.25, 3.0);

/// Gravity, m/s²; the same as of assumption set K0.
pub const GRAVITY_M_S2: f64 = 9.81;
/// Speed of the hubs over the ground, m/s.
pub const SPEED_M_S: Range = Range::logarithmic(0.01, 0.04);
/// Temperature, °C.
pub const TEMPERATURE_C: Range = Range::linear(-40.0, 40.0);
/// Time since the force sensors were zeroed, h: a day's drive.
pub const HOURS_SINCE_ZERO: Range = Range::linear(0.0, 8.0);
/// Way travelled since the last stop, m.
pub const TRAVEL_M: Range = Range::logarithmic(0.1, 30.0);
/// Slip angle, rad: up to 10° to either side.
pub const SLIP_ANGLE_RAD: Range = Range::linear(-0.174_532_925_199_432_95, 0.174_532_925_199_432_95);
/// Height of the grousers of other wheels over radius.
pub const GROUSER_RATIO: Range = Range::linear(0.0, 0.15);

/// Standard deviation of the slope under the rover, rad; it does not average away.
pub const SLOPE_STD_RAD: Range = Range::logarithmic(0.004, 0.05);
/// The same in the comparison of fifth inputs, rad: 1°.
pub const COMPARED_SLOPE_STD_RAD: f64 = 0.017_453_292_519_943_295;

/// Standard deviations as the networks see them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeNoise {
    /// Of DP/W.
    pub drawbar_pull: f64,
    /// Of W/W̄.
    pub load: f64,
    /// Of T/(rW).
    pub torque: f64,
    /// Of the slip.
    pub slip: f64,
    /// Of z/r.
    pub sinkage: f64,
}

impl RelativeNoise {
    /// That of a wheel of some radius among wheels of some mean load.
    pub fn on(&self, load_n: f64, radius_m: f64) -> WheelNoise<f64> {
        WheelNoise {
            drawbar_pull_n: self.drawbar_pull * load_n,
            load_n: self.load * load_n,
            torque_nm: self.torque * load_n * radius_m,
            slip: self.slip,
            sinkage_m: self.sinkage * radius_m,
        }
    }
}
