use super::{Rover, SlipTorqueFilter, SpeedReadings, WheelReadings};

/// A wheel that turns at 0.3 rad/s, one way or the other, at slip 0.2 as far as the camera sees it.
fn readings(direction: f64, torque: f64, seen: bool) -> WheelReadings<f64> {
    WheelReadings {
        speeds: SpeedReadings {
            rate_rad_s: Some(direction * 0.3),
            hub_speed_m_s: seen.then_some(direction * 0.8 * 0.3 * 0.075),
            hub_speed_std_m_s: 5.0e-4,
        },
        rate_std_rad_s: 0.002,
        shared_speed_std_m_s: 5.0e-4,
        roughness: 0.0,
        side_swings: false,
        settled: true,
        rate_repeats: false,
        link_rate_rad_s: 0.0,
        rover_gained: 0.0,
        motor_torque_nm: Some(direction * torque),
        motor_torque_std_nm: 0.05,
    }
}

/// Torque and slip after another frame.
fn after(filter: &mut SlipTorqueFilter<f64>, readings: &WheelReadings<f64>) -> (f64, f64) {
    let _ = filter.tick(0.1, 1.8e-3, readings);
    let [_, torque, slip] = *filter.estimate().mean();
    (torque, slip)
}

/// By how much a wheel whose torque grows from 1.5 to 1.8 N·m, while no camera sees it, is taken to slip more.
fn slips_more(direction: f64) -> f64 {
    let mut filter = SlipTorqueFilter::new(&Rover::<f64>::assumed(), 0);
    let mut slip_after = |torque: f64, seen: bool| after(&mut filter, &readings(direction, torque, seen)).1;
    let before = (0..100).map(|_| slip_after(1.5, true)).last().expect("slips");
    let after = (0..60).map(|frame| slip_after(1.5 + 0.005 * f64::from(frame), false)).last().expect("slips");
    assert!((before - 0.2).abs() < 1.0e-3, "{before}");
    after - before
}

/// A torque that grows by a tenth of load times radius or so is a slip that grows by some hundredths, whichever way the wheel drives.
#[test]
fn a_torque_that_grows_takes_the_slip_along() {
    let (forward, backward) = (slips_more(1.0), slips_more(-1.0));
    assert!(forward > 0.03 && forward < 0.09, "{forward}");
    assert!((forward - backward).abs() < 1.0e-6, "{forward} {backward}");
}

/// A wheel that a rover drags over its soil from one moment to the next: its torque is there within half a second, though it is ninety
/// standard deviations of the drive's sensor from what it was.
#[test]
fn a_torque_that_jumps_is_followed() {
    let mut filter = SlipTorqueFilter::new(&Rover::<f64>::assumed(), 0);
    (0..100).for_each(|_| {
        let _ = after(&mut filter, &readings(1.0, 1.5, true));
    });
    let jumped: Vec<f64> = (0..5).map(|_| after(&mut filter, &readings(1.0, -3.0, true)).0).collect();
    assert!(jumped.last().is_some_and(|torque| (torque + 3.0).abs() < 0.3), "{jumped:?}");
}

/// Noise of the drive's sensor turns a wheel of little inertia, as the filter has it, by far more than it turns: its slip is what the speeds
/// say all the same.
#[test]
fn a_drive_of_little_inertia_keeps_its_slip() {
    let mut rover = Rover::<f64>::assumed();
    rover.drive.reflected_inertia_kg_m2 = 0.005;
    let mut filter = SlipTorqueFilter::new(&rover, 0);
    let noise = |frame: u32| if frame.is_multiple_of(2) { 0.05 } else { -0.05 };
    for frame in 0..200 {
        let (torque, slip) = after(&mut filter, &readings(1.0, 1.5 + noise(frame), true));
        assert!(frame < 20 || ((torque - 1.5).abs() < 0.06 && (slip - 0.2).abs() < 0.005), "{frame}: {torque} {slip}");
    }
}

/// A wheel whose encoder never speaks turns about as fast as the others, and meets the torque that its drive gives.
#[test]
fn a_wheel_without_an_encoder_follows_its_drive() {
    let mut filter = SlipTorqueFilter::new(&Rover::<f64>::assumed(), 0);
    filter.suppose_rate(0.3);
    let mut without = readings(1.0, 1.5, true);
    without.speeds.rate_rad_s = None;
    let torques: Vec<f64> = (0..100).map(|_| after(&mut filter, &without).0).collect();
    let [rate, _, slip] = *filter.estimate().mean();
    let [of_rate, _, of_slip] = filter.estimate().stds();
    assert!(torques.last().is_some_and(|torque| (torque - 1.5).abs() < 1.0e-3), "{torques:?}");
    assert!((rate - 0.3).abs() < of_rate && (slip - 0.2).abs() < of_slip, "{rate} ± {of_rate}, {slip} ± {of_slip}");
    assert!(of_slip > 0.1, "nothing tells the two apart: {of_slip}");
}

/// The drive's inertia goes with the rate against the link: a link that turns faster and faster takes the wheel along, and no torque. (Here
/// the hub's speed goes along, too, so that nothing is told by how the wheel gains on the rover.)
#[test]
fn a_link_that_gains_speed_is_no_torque() {
    let mut filter = SlipTorqueFilter::new(&Rover::<f64>::assumed(), 0);
    (0..100).for_each(|_| {
        let _ = after(&mut filter, &readings(1.0, 1.5, true));
    });
    for frame in 1..=10 {
        let mut turning = readings(1.0, 1.5, true);
        turning.link_rate_rad_s = 0.01 * f64::from(frame);
        let rate = 0.3 - turning.link_rate_rad_s;
        turning.settled = false;
        turning.speeds.rate_rad_s = Some(rate);
        turning.speeds.hub_speed_m_s = Some(0.8 * rate * 0.075);
        let (torque, slip) = after(&mut filter, &turning);
        assert!((torque - 1.5).abs() < 0.02 && (slip - 0.2).abs() < 0.005, "{frame}: {torque} {slip}");
    }
}

/// The slip of a wheel that no camera sees, after its rate has grown by a fifth in two seconds, and its rover's speed by so much of that. Its
/// torque grows with its slip as on sand.
fn slip_at_a_fifth_more(rover_gains: f64) -> f64 {
    let mut filter = SlipTorqueFilter::new(&Rover::<f64>::assumed(), 0);
    (0..100).for_each(|_| {
        let _ = after(&mut filter, &readings(1.0, 1.5, true));
    });
    let gained = 1.2_f64.powf(0.05);
    let mut rate = 0.3;
    let slips = (0..20).map(|_| {
        rate *= gained;
        let slip = 1.0 - 0.8 * (0.3_f64 / rate).powf(1.0 - rover_gains);
        let mut growing = readings(1.0, 1.5 + 2.7 * (slip - 0.2) + 2.1 * rate * (gained - 1.0) / 0.1, false);
        growing.speeds.rate_rad_s = Some(rate);
        growing.rover_gained = rover_gains * (gained - 1.0);
        after(&mut filter, &growing).1
    });
    slips.last().expect("slips")
}

/// Alone it slips by a sixth of its hub's way more; with the rover, no more than before.
#[test]
fn a_wheel_that_gains_speed_alone_slips_more() {
    let (alone, together) = (slip_at_a_fifth_more(0.0), slip_at_a_fifth_more(1.0));
    assert!((alone - (1.0 - 0.8 / 1.2)).abs() < 0.04, "{alone}");
    assert!((together - 0.2).abs() < 0.04, "{together}");
}
