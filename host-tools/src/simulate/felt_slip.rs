//! The slip that the soil under a wheel has felt.
//!
//! A wheel digs by carrying soil away, which takes way: over a step in slip the sinkage goes to its new value with a first-order
//! lag in distance, over about a contact length. So does here the slip that effects on the soil see. The way is that of the
//! faster of rim and ground, the same that slip is measured against: a wheel that spins on the spot digs itself in by the way of
//! its rim, a locked one that is dragged by the way of the ground.

use kapvik_firmware::terramechanics::Wheel;

use super::wheel_soil::WheelMotion;

/// The felt slip, 0 … 1, some time after it was `felt`, where the wheel moves so: ds/dx = (|i| − s)/L, with the length L of
/// the contact on the ground. Under a wheel that stands nothing changes; one in the air will meet fresh soil.
pub fn felt_slip_after(time_s: f64, felt: f64, motion: &WheelMotion, wheel: &Wheel<f64>) -> f64 {
    if motion.sinkage_m <= 0.0 {
        return 0.0;
    }
    let Some(slip) = motion.slip() else { return felt };
    let way_m = time_s * motion.rim_speed_m_s.abs().max(motion.hub_speed_m_s.abs());
    let length_m = (motion.sinkage_m * (2.0 * wheel.radius_m - motion.sinkage_m)).sqrt();
    slip.abs() + (felt - slip.abs()) * libm::exp(-way_m / length_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHEEL: Wheel<f64> = Wheel { radius_m: 0.075, width_m: 0.070 };
    /// Half a radius deep, the contact reaches r √3/2 ahead.
    const DEEP_M: f64 = 0.0375;
    const CONTACT_M: f64 = 0.075 * 0.866_025_403_784_438_6;

    fn motion(rim_speed_m_s: f64, hub_speed_m_s: f64) -> WheelMotion {
        WheelMotion { rim_speed_m_s, hub_speed_m_s, sinkage_m: DEEP_M, sinking_m_s: 0.0 }
    }

    fn after(way_m: f64, felt: f64, rim_speed_m_s: f64, hub_speed_m_s: f64) -> f64 {
        let fastest = rim_speed_m_s.abs().max(hub_speed_m_s.abs());
        felt_slip_after(way_m / fastest, felt, &motion(rim_speed_m_s, hub_speed_m_s), &WHEEL)
    }

    #[test]
    fn it_follows_over_a_contact_length_at_whatever_speed() {
        let left = (-1.0_f64).exp();
        for speed in [0.02, 0.03, -0.03] {
            let found = after(CONTACT_M, 0.8, speed, 0.7 * speed);
            assert!((found - (0.3 + 0.5 * left)).abs() < 1e-12, "{speed} m/s: {found}");
        }
        assert!((after(100.0, 0.8, 0.03, 0.021) - 0.3).abs() < 1e-12);
    }

    /// In as many steps as one likes: the law has no step of its own.
    #[test]
    fn steps_add_up() {
        let whole = after(0.04, 0.0, 0.03, 0.02);
        let steps = (0..100).fold(0.0, |felt, _| after(0.04 / 100.0, felt, 0.03, 0.02));
        assert!((whole - steps).abs() < 1e-12);
    }

    #[test]
    fn wheels_that_spin_on_the_spot_or_are_dragged_dig_and_standing_ones_do_not() {
        let dug = 1.0 - (-1.0_f64).exp();
        for (rim, hub) in [(0.03, 0.0), (0.0, 0.03), (0.0, -0.03)] {
            assert!((after(CONTACT_M, 0.0, rim, hub) - dug).abs() < 1e-12, "{rim} {hub}");
        }
        assert_eq!(felt_slip_after(60.0, 0.4, &motion(0.0, 1e-6), &WHEEL), 0.4);
    }

    #[test]
    fn a_wheel_in_the_air_will_meet_fresh_soil() {
        let lifted = WheelMotion { sinkage_m: -0.001, ..motion(0.03, 0.0) };
        assert_eq!(felt_slip_after(0.1, 0.4, &lifted, &WHEEL), 0.0);
    }
}
