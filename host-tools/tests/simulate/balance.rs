//! Forces in balance, and in agreement with the motion.

use clap::ValueEnum;
use kapvik_firmware::rover::{Rover, Side};
use kapvik_firmware::terramechanics::{Soil, wheel_forces};
use kapvik_host::prior;
use kapvik_host::simulate::audit::imbalance;
use kapvik_host::simulate::balance::Instant;
use kapvik_host::simulate::pose::{Coordinates, Pose};
use kapvik_host::simulate::{BALANCE, Options, Scenario, Traverse};
use nalgebra::{Rotation3, Vector3};

use super::drive;
use super::worse::worse;

/// Runs a drive and looks at each of its instants.
fn each_instant(scenario: Scenario, seed: u64, look: impl FnMut(&Traverse, f64)) {
    each_instant_with(&Options::default(), scenario, seed, look);
}

/// The same of a drive with options.
fn each_instant_with(options: &Options, scenario: Scenario, seed: u64, mut look: impl FnMut(&Traverse, f64)) {
    let rover = Rover::assumed();
    let mut traverse = Traverse::new(scenario, seed, &rover, options).expect("a drive");
    while let Some(row) = traverse.next() {
        let (frame, _) = row.expect("a frame");
        look(&traverse, 1.0e-6 * frame.time_us as f64);
    }
}

#[test]
fn every_body_balances_in_every_frame_of_every_scenario() {
    for scenario in Scenario::value_variants() {
        for seed in 100..103 {
            each_instant(*scenario, seed, |traverse, time_s| {
                let found = imbalance(traverse.world(), traverse.instant());
                assert!(found.worst() <= BALANCE, "{scenario:?} {seed} at {time_s} s: {found:?}");
            });
        }
    }
}

/// A change of any force, torque or acceleration by a hundred-thousandth of a newton is found.
#[test]
fn the_check_of_the_balance_can_fail() {
    let options = Options { duration_s: Some(40.0), ..Options::default() };
    let mut traverse = Traverse::new(Scenario::Hills, 5, &Rover::assumed(), &options).expect("a drive");
    for row in &mut traverse {
        row.expect("a frame");
    }
    let changes: [fn(&mut Instant); 7] = [
        |instant| instant.wheels.left.front.forces.drawbar_pull_n += 1.0e-5,
        |instant| instant.wheels.right.rear.forces.load_n += 1.0e-5,
        |instant| instant.wheels.left.middle.forces.torque_nm += 1.0e-5,
        |instant| instant.wheels.right.front.side_force_n += 1.0e-5,
        |instant| instant.stops_nm.left += 1.0e-5,
        |instant| instant.motion.acceleration_m_s2.x += 1.0e-6,
        |instant| instant.motion.pose.bogie_right += 1.0e-5,
    ];
    for (place, change) in changes.into_iter().enumerate() {
        let mut instant = *traverse.instant();
        assert!(imbalance(traverse.world(), &instant).worst() <= BALANCE);
        change(&mut instant);
        assert!(imbalance(traverse.world(), &instant).worst() > BALANCE, "change {place} is not seen");
    }
}

/// At steady speed on plane ground the pulls carry the weight's share along it and the loads its share across it. What is
/// left over is mass times the acceleration that the wander of the rim speeds brings.
#[test]
fn on_plane_ground_pulls_and_loads_are_those_of_the_weight() {
    let rover = Rover::<f64>::assumed();
    let weight_n = rover.mass_kg * rover.gravity_m_s2;
    for (scenario, slope_deg) in [(Scenario::Level, 0.0_f64), (Scenario::Spread, 0.0), (Scenario::Slope, 10.0)] {
        let (sine, cosine) = slope_deg.to_radians().sin_cos();
        for (frame, truth) in drive(scenario, 3, &Options::default()).iter() {
            if frame.time_us < 10_000_000 {
                continue;
            }
            let pull: f64 = truth.wheels.iter_wheels().map(|wheel| wheel.drawbar_pull_n).sum();
            let load: f64 = truth.wheels.iter_wheels().map(|wheel| wheel.normal_load_n).sum();
            // Wander of 1.2 % of 0.036 m/s at 2π/8 s gives 3.4e-4 m/s² at most, and 41 kg 0.014 N.
            assert!((pull - weight_n * sine).abs() < 0.014, "{scenario:?}: pull {pull}");
            assert!((load - weight_n * cosine).abs() < 0.014, "{scenario:?}: load {load}");
        }
    }
}

/// Away from standstill the wheels' forces are those of equations 1–11 at the true slip and sinkage, on the soil of their side.
#[test]
fn wheels_obey_the_wheel_soil_equations() {
    let one = Options::default();
    let left = prior::soil([300.0, 0.6, 0.015, 1.1, 2.0e6, 0.3, 0.2]);
    let right = Soil { friction_angle_rad: 0.5, cohesion_pa: 2.0e3, ..left };
    let two = Options { soil: Some(left), right_soil: Some(right), ..Options::default() };
    // Damping of the sinking motion is part of the load; how much of it, the code's documentation says.
    for (scenario, options, most) in [
        (Scenario::Level, &one, 0.001),
        (Scenario::Spread, &two, 0.02),
        (Scenario::Hills, &one, 0.02),
        (Scenario::Rock, &one, 0.06),
        (Scenario::SoilChange, &one, 0.4),
    ] {
        let mut worst: f64 = 0.0;
        each_instant_with(options, scenario, 11, |traverse, time_s| {
            if time_s >= 4.0 {
                Side::ALL.as_array().into_iter().for_each(|side| worst = worse(worst, damping_of(traverse, *side)));
            }
        });
        assert!(worst < most, "{scenario:?}: {worst}");
    }
}

/// The greatest share of the load of a side's wheels that is damping, where their other forces are those of the equations.
fn damping_of(traverse: &Traverse, side: Side) -> f64 {
    let (world, instant) = (traverse.world(), traverse.instant());
    let pose = instant.motion.pose;
    let damping = instant.wheels.of(side).map(|wheel| {
        let soil = world.soils.under(side, pose.x + pose.into_world(wheel.hub_m).x);
        let slip = wheel.motion.slip().expect("it moves");
        let forces = wheel_forces(&world.rover.wheel, &soil, slip, wheel.motion.sinkage_m).expect("forces");
        assert_eq!(forces.drawbar_pull_n, wheel.forces.drawbar_pull_n);
        assert_eq!(forces.torque_nm, wheel.forces.torque_nm);
        (wheel.forces.load_n / forces.load_n - 1.0).abs()
    });
    damping.as_array().into_iter().copied().fold(0.0, worse)
}

/// Places that move with the rover, by rotation matrices: hubs and rims' lowest points, then the centre of mass.
fn places(traverse: &Traverse, pose: &Pose) -> Vec<Vector3<f64>> {
    let world = traverse.world();
    let suspension = world.rover.suspension;
    let nose_up = |angle: f64| Rotation3::from_axis_angle(&Vector3::y_axis(), -angle);
    let body = nose_up(pose.pitch) * Rotation3::from_axis_angle(&Vector3::x_axis(), pose.roll);
    let axis = Vector3::new(pose.x, 0.0, pose.z);
    let mut places = Vec::new();
    for (side, rocker, bogie) in
        [(Side::Left, pose.rocker, pose.bogie_left), (Side::Right, -pose.rocker, pose.bogie_right)]
    {
        let y = if side == Side::Left { suspension.half_track_m } else { -suspension.half_track_m };
        let rocker = body * nose_up(rocker);
        let bogie = rocker * nose_up(bogie);
        let end = axis + body * Vector3::new(0.0, y, 0.0);
        let flat = |point: kapvik_firmware::rover::Planar<f64>| Vector3::new(point.x, 0.0, point.z);
        let pivot = end + rocker * flat(suspension.bogie_pivot);
        places.push(end + rocker * flat(suspension.front_hub));
        places.push(pivot + bogie * flat(suspension.middle_hub));
        places.push(pivot + bogie * flat(suspension.rear_hub));
    }
    let centre = suspension.centre_of_mass;
    places.push(axis + body * Vector3::new(centre.x, centre.y, centre.z));
    places
}

/// Velocities of [`places`], by a difference along the rates.
fn velocities(traverse: &Traverse) -> Vec<Vector3<f64>> {
    const STEP_S: f64 = 1.0e-4;
    let motion = &traverse.instant().motion;
    let (pose, rates) = (Coordinates::from(motion.pose), Coordinates::from(motion.rates));
    let [before, after] = [-STEP_S, STEP_S].map(|time| places(traverse, &Pose::from(pose + rates * time)));
    before.iter().zip(&after).map(|(before, after)| (after - before) / (2.0 * STEP_S)).collect()
}

/// Virtual work: what the soil's forces and torques do on the links is what mass and weight take up. A wrong sign or arm
/// anywhere between forces and kinematics would break it.
#[test]
fn the_power_of_the_soil_is_that_of_mass_and_weight() {
    for scenario in [Scenario::Hills, Scenario::Rock, Scenario::Traverse] {
        each_instant(scenario, 7, |traverse, time_s| {
            let instant = traverse.instant();
            let (pose, rates) = (instant.motion.pose, instant.motion.rates);
            let body = Rotation3::from_axis_angle(&Vector3::y_axis(), -pose.pitch)
                * Rotation3::from_axis_angle(&Vector3::x_axis(), pose.roll);
            let axle = body * Vector3::y();
            let moving = velocities(traverse);
            let mut power_w = 0.0;
            let nose_up = rates.pitch * pose.roll.cos();
            let links = [
                (nose_up + rates.rocker, nose_up + rates.rocker + rates.bogie_left),
                (nose_up - rates.rocker, nose_up - rates.rocker + rates.bogie_right),
            ];
            let links = links.iter().flat_map(|(rocker, bogie)| [*rocker, *bogie, *bogie]);
            for ((wheel, velocity), link) in instant.wheels.iter_wheels().zip(&moving).zip(links) {
                let force = wheel.hub_force_n();
                power_w += (body * Vector3::new(force.x, 0.0, force.z)).dot(velocity);
                // A link feels minus the resistive torque, which turns it nose-up.
                power_w += wheel.forces.torque_nm * link;
                // The side force acts on the rim, which swings with the body's roll and yaw under the hub.
                let rim = wheel.contact.normal.scaled(-traverse.world().rover.wheel.radius_m);
                let turn = axle_turn(&pose, &rates);
                let swing = turn.cross(&(body * Vector3::new(rim.x, 0.0, rim.z)));
                power_w += wheel.side_force_n * (velocity + swing).dot(&axle);
            }
            let a = instant.motion.acceleration_m_s2;
            let needed =
                traverse.world().rover.mass_kg * Vector3::new(a.x, a.y, a.z + traverse.world().rover.gravity_m_s2);
            let taken_w = moving.last().map_or(f64::NAN, |centre| needed.dot(centre));
            assert!((power_w - taken_w).abs() < 1.0e-7, "{scenario:?} at {time_s} s: {power_w} W, {taken_w} W");
        });
    }
}

/// The body's rate of turn in the world.
fn axle_turn(pose: &Pose, rates: &Pose) -> Vector3<f64> {
    let pitched = Rotation3::from_axis_angle(&Vector3::y_axis(), -pose.pitch);
    -rates.pitch * Vector3::y() + rates.roll * (pitched * Vector3::x())
}

/// Hub speeds are the rates of the hubs' places: the way that each hub makes between frames, against its speed half-way.
#[test]
fn speeds_integrate_to_places() {
    let (mut at, mut moving, mut tangential) = (Vec::new(), Vec::new(), Vec::new());
    each_instant(Scenario::Hills, 21, |traverse, _| {
        let speeds = velocities(traverse);
        let wheel = &traverse.instant().wheels.left.front;
        let tangent = Vector3::new(wheel.contact_angle_rad.cos(), 0.0, wheel.contact_angle_rad.sin());
        tangential.push(wheel.motion.hub_speed_m_s - speeds[0].dot(&tangent));
        at.push(places(traverse, &traverse.instant().motion.pose));
        moving.push(speeds);
    });
    for hub in 0..6 {
        let way = at[at.len() - 1][hub] - at[0][hub];
        let sum: Vector3<f64> = moving.windows(2).map(|pair| 0.05 * (pair[0][hub] + pair[1][hub])).sum();
        assert!((sum - way).norm() < 2.0e-4 * way.norm(), "hub {hub}: {way:?}, speeds give {sum:?}");
    }
    // Roll tilts the wheel's plane by a few degrees, so the speed along the tangent is that in the plane y = 0 to 1e-4 m/s.
    assert!(tangential.iter().all(|difference: &f64| difference.abs() < 1.0e-4));
}
