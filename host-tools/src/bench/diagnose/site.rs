//! Wheel, soil and loads of a drawn campaign.

use kapvik_firmware::terramechanics::{Soil, Wheel};

use super::chance::Chance;
use crate::data::wheel_file::Grousers;
use crate::prior::{self, Range};

/// Radius of the wheels that are drawn, m.
const RADIUS_M: Range = Range { low: 0.05, high: 0.17, logarithmic: true };
/// Width over radius.
const WIDTH_RATIO: Range = Range { low: 0.5, high: 1.2, logarithmic: false };
/// Height of grousers over radius.
const GROUSER_RATIO: Range = Range { low: 0.04, high: 0.12, logarithmic: true };
/// Number of grousers.
const GROUSERS: (usize, usize) = (10, 36);

/// What does not change during a campaign, as it truly is.
#[derive(Debug, Clone)]
pub struct Site {
    /// The wheel.
    pub wheel: Wheel<f64>,
    /// Its grousers, which act only through an effect.
    pub grousers: Grousers,
    /// The soil.
    pub soil: Soil<f64>,
    /// Mean load, N.
    pub load_n: f64,
    /// Gravity, m/s².
    pub gravity_m_s2: f64,
}

impl Site {
    /// Draws a site, with grousers if they are needed.
    pub fn draw(chance: &mut Chance, grousers_needed: bool) -> Self {
        let radius_m = chance.of(RADIUS_M);
        let wheel = Wheel { radius_m, width_m: radius_m * chance.of(WIDTH_RATIO) };
        let soil = Soil {
            cohesion_pa: chance.of(prior::COHESION_PA),
            friction_angle_rad: chance.of(prior::FRICTION_ANGLE_RAD),
            shear_modulus_m: chance.of(prior::SHEAR_MODULUS_M),
            sinkage_exponent: chance.of(prior::SINKAGE_EXPONENT),
            frictional_modulus: chance.of(prior::STIFFNESS),
            cohesive_modulus: 0.0,
            peak_stress_c1: chance.of(prior::PEAK_STRESS_C1),
            peak_stress_c2: chance.of(prior::PEAK_STRESS_C2),
            rebound_ratio: 0.0,
        };
        let load_n = chance.of(prior::PRESSURE_PA) * wheel.radius_m * wheel.width_m;
        let grousers = if grousers_needed || chance.happens(0.4) {
            let height_m = round_to(radius_m * chance.of(GROUSER_RATIO), 1e-4);
            Grousers { height_m, count: chance.count(GROUSERS.0, GROUSERS.1) as u32 }
        } else {
            Grousers::default()
        };
        let wheel = Wheel { radius_m: round_to(wheel.radius_m, 1e-4), width_m: round_to(wheel.width_m, 1e-4) };
        Self { wheel, grousers, soil, load_n, gravity_m_s2: 9.81 }
    }

    /// Angle of the rim between two grousers, rad; none of a smooth wheel.
    pub fn grouser_pitch_rad(&self) -> Option<f64> {
        (self.grousers.count > 0).then(|| std::f64::consts::TAU / f64::from(self.grousers.count))
    }

    /// About the length of the contact, m: the chord to a depth of a tenth of the radius.
    pub fn contact_length_m(&self) -> f64 {
        0.44 * self.wheel.radius_m
    }
}

/// The multiple of `step` that is nearest to a number.
pub fn round_to(number: f64, step: f64) -> f64 {
    (number / step).round() * step
}
