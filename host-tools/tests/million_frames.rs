//! A million frames, standing, driving and backing up: 28 hours at ten frames a second.

use kapvik_firmware::estimator::{Estimate, RoverEstimator, SideEstimate, WheelEstimate};
use kapvik_firmware::filter::Fusion;
use kapvik_firmware::rover::{PerSide, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::sensor_channels::{values, values_mut};
use kapvik_host::simulate::{Options, Scenario, Traverse};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const FRAMES: usize = 1_000_000;
const FRAME_US: u64 = 100_000;

/// The readings' noise, which no recording that is played again and again should repeat: white, and a walk that wanders
/// by some seven standard deviations over a hundred frames and is drawn back to nothing.
struct Noise {
    std: Vec<f32>,
    walk: Vec<f32>,
    random: ChaCha8Rng,
}

impl Noise {
    /// Of the sensors of a rover, seeded.
    fn new(rover: &Rover<f32>) -> Self {
        let noise = rover.noise;
        let wheel = [noise.wheel_rate_rad_s, noise.motor_torque_nm, noise.load_cell_n];
        let axes = [noise.accel_m_s2, noise.gyro_rad_s, noise.velocity_m_s];
        let wheels = [wheel; 6].into_iter().flatten();
        let std: Vec<f32> =
            wheels.chain([noise.angle_rad; 3]).chain(axes.into_iter().flat_map(|std| [std; 3])).collect();
        Self { walk: vec![0.0; std.len()], std, random: ChaCha8Rng::seed_from_u64(2026) }
    }

    fn add(&mut self, frame: &mut SensorFrame) {
        assert_eq!(values(frame).len(), self.std.len());
        for ((value, std), walk) in values_mut(frame).zip(&self.std).zip(&mut self.walk) {
            let mut unit = || std * (12.0_f32.sqrt() * (self.random.random::<f32>() - 0.5));
            *walk = 0.99 * *walk + unit();
            let white = unit();
            *value = value.map(|value| value + white + *walk);
        }
    }
}

fn numbers(side: &SideEstimate) -> impl Iterator<Item = Estimate> {
    let of_wheel = |wheel: &WheelEstimate| {
        let parts = [wheel.shared_slip_std, wheel.split_std_n, wheel.drawbar_pull_by_load_n];
        let parts = parts.map(|value| Estimate { value, std: 0.0 });
        let forces = [wheel.resistive_torque_nm, wheel.contact_angle_rad, wheel.normal_load_n, wheel.drawbar_pull_n];
        parts.into_iter().chain(forces).chain(wheel.slip)
    };
    let wheels: Vec<Estimate> = side.wheels.as_array().into_iter().flat_map(of_wheel).collect();
    wheels.into_iter().chain([side.bogie_drawbar_pull_n])
}

/// Updates of the last frame that ended in a failed factorisation.
fn failed_updates(estimator: &RoverEstimator<f32>) -> u32 {
    let of_side = |side: &kapvik_firmware::estimator::SideInnovations<f32>| {
        let wheels = side.wheels.as_array().into_iter().filter(|told| told.fusion == Fusion::Reset).count();
        wheels + usize::from(side.angles.fusion == Fusion::Reset) + usize::from(side.forces.fusion == Fusion::Reset)
    };
    let PerSide { left, right } = estimator.innovations().expect("it has begun");
    (of_side(left) + of_side(right)) as u32
}

#[test]
fn a_million_frames_end_in_numbers_and_no_failure_is_kept_quiet() {
    let rover = Rover::<f32>::assumed();
    let drive = Traverse::new(Scenario::StartStop, 40, &Rover::assumed(), &Options::default()).expect("a drive");
    let recorded: Vec<SensorFrame> = drive.run().expect("frames").into_iter().map(|(frame, _)| frame).collect();
    let mut estimator = RoverEstimator::new(&rover);
    let mut noise = Noise::new(&rover);
    let mut seen = 0;
    for (index, frame) in recorded.iter().cycle().take(FRAMES).enumerate() {
        let mut frame = SensorFrame { time_us: index as u64 * FRAME_US, ..*frame };
        noise.add(&mut frame);
        let _ = estimator.tick(&frame);
        seen += failed_updates(&estimator);
        for side in estimator.estimate().as_array() {
            let good = |number: Estimate| number.value.is_finite() && number.std.is_finite() && number.std >= 0.0;
            assert!(numbers(side).all(good), "frame {index}: {side:?}");
        }
        assert!(estimator.pitch_rad().is_finite() && estimator.pitch_std_rad().is_finite(), "frame {index}");
        assert!(estimator.health().filter_resets >= seen, "frame {index}: {seen} failures, and not all were counted");
    }
    let health = estimator.health();
    assert_eq!(health.frames as usize, FRAMES);
    println!("failed factorisations {}, beliefs given up {}", health.filter_resets, health.relearned);
    assert_eq!(health.filter_resets, 0, "nothing in these frames is beyond single precision");
}
