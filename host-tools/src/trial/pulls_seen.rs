//! Where the errors of the pulls come from, and what the sensors tell of them at the best.
//!
//! The bound of Cramér and Rao of one who is told more than any estimator: that the ground is plane, alike under both sides,
//! and that no force changes, so that every frame since the wheels began to roll counts the same. Contact angles come
//! from the direction in which the velocimeter sees the axis go; forces from cells, moments on bogies and rockers, and
//! the accelerometer, which feels the sum of all. No estimator that has to find out whether the ground is plane comes near it.

use kapvik_firmware::estimator::hub_force::{self, HubForceModel};
use kapvik_firmware::estimator::{STANDING_M_S, WheelEstimate};
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::{PerWheel, Rover};
use nalgebra::{Cholesky, SMatrix, SVector};

use crate::data::truth_file::{Truth, WheelTruth};

/// Forces of one side; of both.
const SIDE: usize = hub_force::STATES;
const BOTH: usize = 2 * SIDE;
/// Places of the forces along rocker and bogie among those of a side.
const ALONG_ROCKER: usize = 3;
const ALONG_BOGIE: usize = 4;

/// Mean squares over frames.
#[derive(Debug, Clone, Copy, Default)]
pub struct MeanSquare {
    sum: f64,
    count: f64,
}

impl MeanSquare {
    fn take(&mut self, square: f64) {
        self.sum += square;
        self.count += 1.0;
    }

    /// Adds what another counted.
    pub fn add(&mut self, other: &Self) {
        self.sum += other.sum;
        self.count += other.count;
    }

    /// The root of the mean.
    pub fn root(&self) -> f64 {
        (self.sum / self.count).sqrt()
    }
}

/// What is said of angles and pulls over a drive.
#[derive(Debug, Clone, Copy, Default)]
pub struct PullsSeen {
    /// Frames since the wheels began to roll.
    frames: f64,
    /// Information on the direction of travel, 1/rad².
    direction: f64,
    /// The bound on a contact angle, rad.
    pub angle_bound: MeanSquare,
    /// The bound on a front wheel's pull, N.
    pub front_bound: MeanSquare,
    /// The bound on the sum of a bogie's pulls, N.
    pub bogie_bound: MeanSquare,
    /// Error of a front wheel's pull where the true contact angle is told, N.
    pub front_told: MeanSquare,
    /// Error of a bogie's sum where the true contact angles are told, N.
    pub bogie_told: MeanSquare,
}

impl PullsSeen {
    /// Takes a frame of a rover at a speed; its errors count where `counted`.
    pub fn take(&mut self, rover: &Rover<f64>, speed_m_s: f64, estimate: &FrameEstimate, truth: &Truth, counted: bool) {
        if speed_m_s.abs() < STANDING_M_S {
            return;
        }
        self.frames += 1.0;
        self.direction += (speed_m_s / rover.noise.velocity_m_s).powi(2);
        if !counted {
            return;
        }
        let wheels: PerWheel<(WheelEstimate, WheelTruth)> = estimate.wheels.zip_wheels(truth.wheels);
        for side in wheels.as_array() {
            let error = side.as_ref().map(|(estimate, truth)| told_the_angle(estimate, truth) - truth.drawbar_pull_n);
            self.front_told.take(error.front.powi(2));
            self.bogie_told.take((error.middle + error.rear).powi(2));
        }
        let Some([front, bogie]) = variances_of_a_frame(rover) else { return };
        let angle = 1.0 / self.direction;
        for side in truth.wheels.as_array() {
            let load = side.as_ref().map(|wheel| wheel.normal_load_n);
            self.angle_bound.take(angle);
            self.front_bound.take(front / self.frames + load.front.powi(2) * angle);
            self.bogie_bound.take(bogie / self.frames + (load.middle + load.rear).powi(2) * angle);
        }
    }
}

/// The pull that the estimated force on a hub has along the true contact, N.
fn told_the_angle(estimate: &WheelEstimate, truth: &WheelTruth) -> f64 {
    let [load, pull, angle] = [estimate.normal_load_n, estimate.drawbar_pull_n, estimate.contact_angle_rad]
        .map(|estimate| f64::from(estimate.value));
    let (sine, cosine) = (truth.contact_angle_rad - angle).sin_cos();
    pull * cosine + load * sine
}

/// Variances of the forces along rocker and along bogie that the white noise of one frame leaves, N², with the links level.
fn variances_of_a_frame(rover: &Rover<f64>) -> Option<[f64; 2]> {
    let noise = &rover.noise;
    let model = HubForceModel::new(&rover.suspension, (0.0, 1.0));
    let centre = rover.suspension.centre_of_mass;
    let body = 0.5 * rover.mass_kg * noise.accel_m_s2 * centre.x.hypot(centre.z);
    let torque = noise.motor_torque_nm;
    let stds = [noise.load_cell_n, noise.load_cell_n, noise.load_cell_n, torque.hypot(torque), torque.hypot(body)];
    let mut information = SMatrix::<f64, BOTH, BOTH>::zeros();
    let mut told = |row: SVector<f64, BOTH>, std: f64| information += row * row.transpose() / (std * std);
    for first in [0, SIDE] {
        for (measurement, std) in stds.into_iter().enumerate() {
            let slope = |state: usize| {
                let mut unit = [0.0; SIDE];
                unit[state] = 1.0;
                model.measure(&unit)[measurement]
            };
            told(
                SVector::from_fn(|state, _| if state / SIDE == first / SIDE { slope(state % SIDE) } else { 0.0 }),
                std,
            );
        }
    }
    let sum = |places: std::ops::Range<usize>| {
        SVector::from_fn(|state, _| if places.contains(&(state % SIDE)) { 1.0 } else { 0.0 })
    };
    told(sum(ALONG_ROCKER..SIDE), rover.mass_kg * noise.accel_m_s2);
    told(sum(0..ALONG_ROCKER), rover.mass_kg * noise.accel_m_s2);
    let covariance = Cholesky::new(information)?.inverse();
    Some([ALONG_ROCKER, ALONG_BOGIE].map(|place| covariance[(place, place)]))
}

#[cfg(test)]
mod tests {
    use super::variances_of_a_frame;
    use kapvik_firmware::rover::Rover;

    /// Without an accelerometer the moment on a bogie alone tells its pull: cells of 0.5 N on arms of 0.175 m and two torques
    /// of 0.05 N·m, on a height of 0.1 m. With one it is known better, but never as well as by the sum alone.
    #[test]
    fn the_balance_of_the_whole_rover_adds_to_what_the_moments_tell() {
        let mut rover = Rover::<f64>::assumed();
        let with = variances_of_a_frame(&rover).expect("information")[1];
        rover.noise.accel_m_s2 = 1.0e3;
        let without = variances_of_a_frame(&rover).expect("information")[1];
        let expected = (2.0 * (0.175_f64 * 0.5).powi(2) + 2.0 * 0.05_f64.powi(2)) / 0.01;
        assert!((without / expected - 1.0).abs() < 1.0e-3, "{without} {expected}");
        assert!(with < 0.9 * without && with > 0.25 * (41.0_f64 * 0.02).powi(2), "{with} {without}");
    }
}
