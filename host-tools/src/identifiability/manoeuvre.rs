//! What a driver can tell a rover to do so that its soil shows.

use std::fmt;

use kapvik_firmware::rover::{Axle, PerAxle};
use serde::Serialize;

use super::steady_drive::Drives;
use crate::statistics::sorted;

/// How the wheels of a leg are driven; those of one axle alike.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Rim speeds, over that of the axle that the others are compared with.
    Roll(PerAxle<f64>),
    /// The wheels of one axle spin while those of the others are held.
    Spin(Axle),
}

/// A part of a manoeuvre.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Leg {
    /// How the wheels are driven.
    pub pattern: Pattern,
    /// Slope of the ground, rad, uphill.
    pub slope_rad: f64,
}

/// Rim speeds that a rover drives at.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RimSpeeds {
    /// Of the usual drive, m/s.
    pub usual_m_s: f64,
    /// The greatest, m/s.
    pub top_m_s: f64,
}

impl Default for RimSpeeds {
    /// The top speed is Kapvik's, 0.1 km/h.
    fn default() -> Self {
        Self { usual_m_s: 0.02, top_m_s: 0.028 }
    }
}

/// All rims alike on level ground.
pub const USUAL: Leg = Leg { pattern: Pattern::Roll(PerAxle { front: 1.0, middle: 1.0, rear: 1.0 }), slope_rad: 0.0 };

impl Pattern {
    /// What the drives are told: the usual speed for the axle that the others are compared with, or less where another would
    /// be too fast.
    pub fn drives(&self, speeds: &RimSpeeds) -> Drives {
        match self {
            Self::Roll(ratios) => {
                let greatest = ratios.into_array().into_iter().fold(1.0, f64::max);
                let base_m_s = speeds.usual_m_s.min(speeds.top_m_s / greatest);
                Drives::Roll(ratios.map(|ratio| ratio * base_m_s))
            }
            Self::Spin(axle) => Drives::Spin(*axle, speeds.usual_m_s),
        }
    }

    /// Whether the ratio that the others are compared with is one: the ratio that two axles share, else the middle one.
    pub fn is_canonical(&self) -> bool {
        let Self::Roll(ratios) = self else { return true };
        // Of three sorted numbers, the middle one is also that which two share.
        sorted(ratios.into_array())[1] == 1.0
    }
}

impl Leg {
    /// Whether it is on level ground.
    pub fn is_level(&self) -> bool {
        self.slope_rad == 0.0
    }

    /// Whether wheels spin on the spot.
    pub fn spins(&self) -> bool {
        matches!(self.pattern, Pattern::Spin(_))
    }
}

impl fmt::Display for Leg {
    /// As an order to a driver.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.pattern {
            Pattern::Roll(ratios) => roll(f, ratios)?,
            Pattern::Spin(axle) => write!(f, "stand and spin the {} wheels", axle_name(*axle))?,
        }
        let degrees = self.slope_rad.to_degrees();
        match degrees.total_cmp(&0.0) {
            _ if self.is_level() => Ok(()),
            std::cmp::Ordering::Less => write!(f, " down a slope of {:.0}°", -degrees),
            _ => write!(f, " up a slope of {degrees:.0}°"),
        }
    }
}

fn roll(f: &mut fmt::Formatter<'_>, ratios: &PerAxle<f64>) -> fmt::Result {
    let unlike: Vec<(Axle, f64)> =
        Axle::ALL.into_array().into_iter().map(|axle| (axle, *ratios.of(axle))).filter(|pair| pair.1 != 1.0).collect();
    if unlike.is_empty() {
        return write!(f, "drive all wheels alike");
    }
    write!(f, "drive ")?;
    for (place, (axle, ratio)) in unlike.iter().enumerate() {
        let percent = 100.0 * (ratio - 1.0).abs();
        let how = if *ratio > 1.0 { "faster" } else { "slower" };
        write!(f, "{}the {} wheels {percent:.0} % {how}", if place > 0 { " and " } else { "" }, axle_name(*axle))?;
    }
    Ok(())
}

/// An axle in words.
pub fn axle_name(axle: Axle) -> &'static str {
    match axle {
        Axle::Front => "front",
        Axle::Middle => "middle",
        Axle::Rear => "rear",
    }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::rover::{Axle, PerAxle};

    use super::{Leg, Pattern, RimSpeeds, USUAL};
    use crate::identifiability::steady_drive::Drives;

    #[test]
    fn orders_read_as_orders() {
        let leg = |ratios: [f64; 3], slope_deg: f64| Leg {
            pattern: Pattern::Roll(PerAxle::from_array(ratios)),
            slope_rad: slope_deg.to_radians(),
        };
        assert_eq!(USUAL.to_string(), "drive all wheels alike");
        assert_eq!(leg([1.0, 1.3, 1.0], 0.0).to_string(), "drive the middle wheels 30 % faster");
        let both = "drive the front wheels 20 % slower and the rear wheels 60 % faster down a slope of 10°";
        assert_eq!(leg([0.8, 1.0, 1.6], -10.0).to_string(), both);
        let spin = Leg { pattern: Pattern::Spin(Axle::Rear), slope_rad: 0.0 };
        assert_eq!(spin.to_string(), "stand and spin the rear wheels");
    }

    #[test]
    fn no_rim_is_faster_than_the_rover_can() {
        let pattern = Pattern::Roll(PerAxle::from_array([1.0, 2.0, 1.0]));
        let expected = PerAxle::from_array([0.014, 0.028, 0.014]);
        assert_eq!(pattern.drives(&RimSpeeds::default()), Drives::Roll(expected));
    }
}
