//! What a whole tick costs on the target: gates, both filters for six wheels, networks, soil over time. Run under `-icount
//! shift=0`; an image of its own, since the functions of the other measuring image fill the part.
#![no_std]
#![no_main]

use kapvik_board_an386::{bench::Bench, entry, exit};
use kapvik_firmware::pipeline::Pipeline;
use kapvik_firmware::rover::{Axes, PerAxle, PerSide, Rover};
use kapvik_firmware::sensor_frame::{SensorFrame, WheelSensors};

#[entry]
fn main() -> ! {
    let bench = Bench::start();
    if let Ok(mut pipeline) = Pipeline::new(&Rover::assumed()) {
        let mut time_us = 0;
        bench.kernel("tick", -1.0, 1.0, |wobble| {
            time_us += 100_000;
            *pipeline.tick(&frame(time_us, wobble))
        });
    }
    exit(0)
}

/// A frame of a rover that drives over level ground, no two readings alike.
fn frame(time_us: u64, wobble: f32) -> SensorFrame {
    let wheel = |share: f32| WheelSensors {
        rate_rad_s: Some(0.3 + 0.05 * share + 0.002 * wobble),
        motor_torque_nm: Some(1.4 + 0.3 * share + 0.05 * wobble),
        load_cell_n: Some(67.0 - 3.0 * share + 0.5 * wobble),
    };
    let side = |share: f32| PerAxle { front: wheel(share), middle: wheel(-share), rear: wheel(0.5 * share) };
    SensorFrame {
        time_us,
        wheels: PerSide { left: side(1.0), right: side(-0.7) },
        bogie_angle_rad: PerSide { left: Some(0.001 * wobble), right: Some(-0.001 * wobble) },
        rocker_angle_rad: Some(0.0007 * wobble),
        accel_m_s2: Axes { x: Some(0.02 * wobble), y: Some(-0.02 * wobble), z: Some(9.81 + 0.01 * wobble) },
        gyro_rad_s: Axes { x: Some(0.001 * wobble), y: Some(-0.001 * wobble), z: Some(0.0005 * wobble) },
        velocity_m_s: Axes { x: Some(0.018 + 0.0005 * wobble), y: Some(0.0), z: Some(0.0005 * wobble) },
    }
}
