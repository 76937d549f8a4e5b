//! The slip of a wheel by the speeds of its rim and its hub alone: what filter 1 starts from where nothing else is known of it.

use crate::scalar::Scalar;

/// One standard deviation of how far such a slip may be from that of the frame, and the greatest with which it tells one.
const JUMPS: f64 = 0.1;
const GREATEST_STD: f64 = 0.2;
/// A rim that turns with less than this share of the hub's speed may stand, by its encoder's noise.
const TURNS: f64 = 0.1;

/// How fast rim and hub of a wheel are said to move.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpeedReadings<S> {
    /// Absolute rate, rad/s: encoder and link.
    pub rate_rad_s: Option<S>,
    /// Speed of the hub along its contact, m/s.
    pub hub_speed_m_s: Option<S>,
    /// One standard deviation of that, m/s.
    pub hub_speed_std_m_s: S,
}

impl<S: Scalar> SpeedReadings<S> {
    /// The slip that they make of a wheel of such a radius, m, with one standard deviation; none of a wheel that is too slow to tell it.
    pub fn slip(&self, radius_m: S) -> Option<(S, S)> {
        let (rate, hub) = (self.rate_rad_s?, self.hub_speed_m_s?);
        let rim = radius_m * rate;
        let std = S::constant(JUMPS) + self.hub_speed_std_m_s / rim.abs().max(hub.abs());
        (std < S::constant(GREATEST_STD)).then(|| (slip_by(rim, hub), std))
    }
}

/// The slip that speeds of rim and hub make, m/s, one of which is not zero, −1 … 1: 1 − v/(r ω) when driving, r ω/v − 1 when braking. Where
/// they move oppositely it is 1 of a rim that drives forward, and −1 of one that turns back or hardly turns.
pub fn slip_by<S: Scalar>(rim: S, hub: S) -> S {
    let one = S::one();
    if rim * hub < S::zero() {
        return if rim > S::constant(TURNS) * hub.abs() { one } else { -one };
    }
    if hub.abs() <= rim.abs() { one - hub / rim } else { rim / hub - one }
}

#[cfg(test)]
mod tests {
    use super::SpeedReadings;

    /// A wheel of 75 mm that drives, brakes, is dragged while it turns back a little, drives backward, slides back while it drives, is
    /// dragged backward, turns back while it rolls on, or is too slow.
    #[test]
    fn a_slip_is_the_quotient_of_the_speeds() {
        let slip = |rate_rad_s: f64, hub_m_s: f64| {
            let (rate_rad_s, hub_speed_m_s) = (Some(rate_rad_s), Some(hub_m_s));
            SpeedReadings { rate_rad_s, hub_speed_m_s, hub_speed_std_m_s: 5.0e-4 }.slip(0.075)
        };
        let is = |found: Option<(f64, f64)>, expected: f64, std: f64| {
            found.is_some_and(|(slip, of_it)| (slip - expected).abs() < 1.0e-12 && (of_it - std).abs() < 1.0e-12)
        };
        assert!(is(slip(0.4, 0.024), 0.2, 0.1 + 5.0e-4 / 0.03));
        assert!(is(slip(0.2, 0.03), -0.5, 0.1 + 5.0e-4 / 0.03));
        assert!(is(slip(-0.01, 0.03), -1.0, 0.1 + 5.0e-4 / 0.03));
        assert!(is(slip(-0.4, -0.024), 0.2, 0.1 + 5.0e-4 / 0.03));
        assert!(is(slip(0.3, -0.03), 1.0, 0.1 + 5.0e-4 / 0.03));
        assert!(is(slip(0.01, -0.03), -1.0, 0.1 + 5.0e-4 / 0.03));
        assert!(is(slip(-0.4, 0.024), -1.0, 0.1 + 5.0e-4 / 0.03));
        assert!(slip(0.04, 0.003).is_none());
        assert!(
            SpeedReadings { rate_rad_s: None, hub_speed_m_s: Some(0.03), hub_speed_std_m_s: 0.0 }.slip(0.075).is_none()
        );
    }
}
