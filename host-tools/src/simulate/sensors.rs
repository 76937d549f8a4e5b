//! What the sensors say of an instant, before faults.

use kapvik_firmware::rover::{Axes, Axle, PerAxle, PerSide, PerWheel, Planar, Side};
use kapvik_firmware::sensor_frame::{SensorFrame, WheelSensors};
use kapvik_firmware::terramechanics::effects::Conditions;
use kapvik_firmware::terramechanics::{Memory, WheelTruth};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::balance::{Instant, World};
use super::effects::RoverEffects;
use super::programme::WheelTurn;
use crate::data::sensor_channels::{values, values_mut};

/// The readings of an instant without noise, with the effects that act on sensors and drives. Force sensors were zeroed
/// at time zero.
pub fn readings(
    world: &World,
    instant: &Instant,
    turns: &PerWheel<WheelTurn>,
    time_s: f64,
    effects: &RoverEffects,
) -> SensorFrame {
    let motion = &instant.motion;
    let body = motion.pose.motion(&motion.rates);
    let misaligned = effects.library.pitch_misalignment;
    let tilt_rad = misaligned.map_or(0.0, |tilt| tilt.tilt_rad + tilt.pitch_share * motion.pose.pitch);
    let mounted = |vector: Axes<f64>| {
        let tilted = Planar { x: vector.x, z: vector.z }.turned_back(libm::sincos(tilt_rad));
        Axes { x: tilted.x, z: tilted.z, ..vector }.map(reading)
    };
    SensorFrame {
        time_us: 0,
        wheels: Side::ALL.map(|side| {
            let up = bracket_axes(instant, side);
            Axle::ALL.map(|axle| {
                let turn = turns.of_wheel(side, axle);
                wheel_sensors(world, instant, (side, axle), *up.of(axle), turn, time_s)
            })
        }),
        bogie_angle_rad: PerSide { left: motion.pose.bogie_left, right: motion.pose.bogie_right }.map(reading),
        rocker_angle_rad: reading(motion.pose.rocker),
        accel_m_s2: mounted(instant.specific_force_m_s2),
        gyro_rad_s: mounted(body.turn_rad_s),
        velocity_m_s: body.velocity_m_s.map(|speed| reading(speed * (1.0 + effects.velocity_scale))),
    }
}

/// What encoder, drive and load cell of a wheel say; `up` is the cell's axis.
fn wheel_sensors(
    world: &World,
    instant: &Instant,
    (side, axle): (Side, Axle),
    up: Planar<f64>,
    turn: &WheelTurn,
    time_s: f64,
) -> WheelSensors {
    let (radius_m, inertia_kg_m2) = (world.rover.wheel.radius_m, world.rover.drive.reflected_inertia_kg_m2);
    let wheel = instant.wheels.of_wheel(side, axle);
    let rate_rad_s = turn.rim_speed_m_s / radius_m;
    let ahead = Planar { x: up.z, z: -up.x };
    let force = wheel.hub_force_n();
    // The load cell is the load, and what it squares with the pull.
    let truth = WheelTruth {
        slip: wheel.motion.slip().unwrap_or(0.0),
        load_n: force.dot(up),
        drawbar_pull_n: force.dot(ahead),
        torque_nm: wheel.forces.torque_nm + inertia_kg_m2 * turn.rim_acceleration_m_s2 / radius_m,
        sinkage_m: wheel.motion.sinkage_m,
        side_force_n: wheel.side_force_n,
    };
    let pose = &instant.motion.pose;
    let conditions = Conditions {
        wheel_rate_rad_s: Some(rate_rad_s),
        hours_since_zero: Some(time_s / 3600.0),
        ..world.conditions(side, axle, &instant.motion)
    };
    let soil = world.soils.under(side, pose.x + pose.into_world(wheel.hub_m).x);
    let read = world.on(&soil).readings(&conditions, &truth, &mut Memory::start());
    WheelSensors {
        rate_rad_s: reading(rate_rad_s),
        motor_torque_nm: reading(read.torque_nm),
        load_cell_n: reading(read.load_n),
    }
}

/// The load cells' axes in the plane of a side: square to rocker or bogie.
fn bracket_axes(instant: &Instant, side: Side) -> PerAxle<Planar<f64>> {
    let joints = instant.motion.pose.joints(&instant.motion.rates, side);
    let up = Planar { x: 0.0, z: 1.0 };
    let rocker = up.turned(libm::sincos(joints.rocker.pitch_rad));
    let bogie = up.turned(libm::sincos(joints.rocker.pitch_rad + joints.bogie.pitch_rad));
    PerAxle { front: rocker, middle: bogie, rear: bogie }
}

/// A reading in the sensors' precision.
fn reading(value: f64) -> Option<f32> {
    Some(value as f32)
}

/// Adds white noise to every channel: as many draws in every frame, so that a missing sensor changes no other's noise.
pub fn add_noise(frame: &mut SensorFrame, standard_deviations: &SensorFrame, random: &mut ChaCha8Rng) {
    for (value, std) in values_mut(frame).zip(values(standard_deviations)) {
        let normal: f64 = StandardNormal.sample(random);
        if let (Some(value), Some(std)) = (value, std) {
            *value = (f64::from(*value) + normal * f64::from(std)) as f32;
        }
    }
}
