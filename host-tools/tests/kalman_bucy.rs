//! The flight's discrete filter against the continuous-time unscented Kalman–Bucy filter over the same models.
//!
//! Both get the same sensors of a slow traverse and the same process noise, fixed: the discrete one Q_d per frame and R_d per
//! reading, the continuous one the densities Q_c = Q_d/Δt and R_c = R_d Δt, with a reading held for its frame. They agree
//! as far as a frame is short against the time in which a filter forgets. The measure is the root mean square of
//! their difference over the root mean square of the quantity, both over the drive after its start.

use std::array::from_fn;

use kapvik_firmware::estimator::contact_angle::{self, ContactAngleModel};
use kapvik_firmware::estimator::hub_force::{self, HubForceModel};
use kapvik_firmware::estimator::slip_torque::{self, SlipTorqueModel};
use kapvik_firmware::filter::{Fusion, Gate, Gaussian, Prediction, SigmaPointFilter};
use kapvik_firmware::rover::{Axes, PerAxle, RollingSide, Rover, body_moment_nm};
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::reference::continuous_model::ContinuousModel;
use kapvik_host::reference::kalman_bucy::{Drive, KalmanBucyFilter};
use kapvik_host::simulate::{Options, RATE_HZ, Scenario, Traverse};

const STEP_S: f64 = 1.0 / RATE_HZ;
/// From then on all wheels roll, s.
const ROLLING_S: f64 = 3.0;
/// From then on the filters are compared, s.
const STARTED_S: f64 = 10.0;
/// How far the two may be apart.
const BOUND: f64 = 0.02;

/// The same estimate by both methods.
struct Pair<const N: usize, const M: usize> {
    discrete: SigmaPointFilter<f64, N>,
    continuous: KalmanBucyFilter<N>,
    /// One standard deviation of the drift of each state in a frame.
    drift: [f64; N],
    /// One standard deviation of each measurement.
    noise: [f64; M],
    /// Sums of squares: of the difference, and of the quantity.
    squares: [[f64; 2]; N],
}

impl<const N: usize, const M: usize> Pair<N, M> {
    fn new(mean: [f64; N], std: [f64; N], drift: [f64; N], noise: [f64; M]) -> Self {
        let start = Gaussian::independent(mean, std).expect("numbers");
        let discrete = SigmaPointFilter::new(start, std).expect("numbers");
        Self { discrete, continuous: KalmanBucyFilter::new(mean, std), drift, noise, squares: [[0.0; 2]; N] }
    }

    /// A frame: the model's inputs hold over it, and the readings are those of its end.
    fn tick(&mut self, model: &impl ContinuousModel<N, M>, measured: [f64; M]) {
        let process = |state: &[f64; N]| {
            let rates = model.rates(state);
            from_fn(|index| state[index] + STEP_S * rates[index])
        };
        assert_eq!(self.discrete.predict(process, &self.drift), Prediction::Done);
        let told = self.discrete.update(|state| model.measure(state), &measured.map(Some), &self.noise, Gate::Open);
        assert_eq!(told.fusion, Fusion::Done);
        let process_density = self.drift.map(|std| std * std / STEP_S);
        let noise_density = self.noise.map(|std| std * std * STEP_S);
        let drive = Drive { process_density, measured, noise_density };
        self.continuous.advance(STEP_S, model, &drive).expect("positive definite");
    }

    fn compare(&mut self) {
        let estimates = self.discrete.estimate().mean().iter().zip(self.continuous.mean());
        for ((discrete, continuous), [difference, quantity]) in estimates.zip(&mut self.squares) {
            *difference += (discrete - continuous).powi(2);
            *quantity += continuous.powi(2);
        }
    }

    fn check(&self, name: &str) {
        let differences = self.squares.map(|[difference, quantity]| (difference / quantity).sqrt());
        println!("{name}: {differences:.4?}, {} steps", self.continuous.steps());
        assert!(differences.iter().all(|difference| *difference <= BOUND), "{name}: {differences:?}");
    }
}

/// The filters of the left side, each by both methods.
struct Side {
    rover: Rover<f64>,
    wheels: [Pair<{ slip_torque::STATES }, { slip_torque::MEASUREMENTS }>; 3],
    angles: Pair<{ contact_angle::STATES }, { contact_angle::MEASUREMENTS }>,
    forces: Pair<{ hub_force::STATES }, { hub_force::MEASUREMENTS }>,
}

/// What a frame says of the left side.
struct Readings {
    rates: [f64; 3],
    torques: [f64; 3],
    cells: [f64; 3],
    /// Of the side's end of the differential axis, forward and up.
    velocity: [f64; 2],
    rocker: f64,
    /// Of the body, by the accelerometer and its rate by the gyro, nose-up.
    pitch: f64,
    pitch_rate: f64,
    bogie: f64,
    specific_force: Axes<f64>,
}

impl Readings {
    fn new(frame: &SensorFrame, rover: &Rover<f64>) -> Self {
        let given = |value: Option<f32>| f64::from(value.expect("a reading"));
        let wheels = frame.wheels.left.into_array();
        let velocity = frame.velocity_m_s.map(given);
        let turn = frame.gyro_rad_s.map(given);
        let specific_force = frame.accel_m_s2.map(given);
        let left = rover.suspension.half_track_m;
        Self {
            rates: wheels.map(|wheel| given(wheel.rate_rad_s)),
            torques: wheels.map(|wheel| given(wheel.motor_torque_nm)),
            cells: wheels.map(|wheel| given(wheel.load_cell_n)),
            velocity: [velocity.x - turn.z * left, velocity.z + turn.x * left],
            rocker: given(frame.rocker_angle_rad),
            bogie: given(frame.bogie_angle_rad.left),
            pitch: specific_force.x.atan2(specific_force.z),
            pitch_rate: -turn.y,
            specific_force,
        }
    }
}

impl Side {
    /// With the drift of a frame at two centimetres a second over smooth ground: a third of the flight filters' nominal one.
    fn new(rover: Rover<f64>) -> Self {
        let noise = rover.noise;
        let root_way = 0.3 * (0.02 * STEP_S).sqrt();
        let speed = noise.velocity_m_s.hypot(noise.gyro_rad_s * rover.suspension.half_track_m);
        let torque = noise.motor_torque_nm;
        let rate_drift = STEP_S * torque / rover.drive.reflected_inertia_kg_m2;
        let wheel = || {
            let drift = [rate_drift, 1.1 * root_way, 0.37 * root_way];
            Pair::new([0.0, 0.0, 0.2], [1.0, 5.0, 0.5], drift, [noise.wheel_rate_rad_s, speed])
        };
        let [ratio, angle, pitch] = [0.2, 0.32, 1.0e-3].map(|drift| drift * root_way);
        let weight = rover.mass_kg * rover.gravity_m_s2;
        let load = weight / 6.0;
        let cell = noise.load_cell_n;
        Self {
            rover,
            wheels: [wheel(), wheel(), wheel()],
            angles: Pair::new(
                [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                [0.3, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2],
                [ratio, angle, angle, angle, pitch, pitch, STEP_S * noise.gyro_rad_s],
                [speed, speed, noise.angle_rad, noise.angle_rad, noise.accel_m_s2 / rover.gravity_m_s2],
            ),
            forces: Pair::new(
                [load, load, load, 0.0, 0.0],
                [0.3 * weight; hub_force::STATES],
                [21.0 * root_way; hub_force::STATES],
                [cell, cell, cell, torque.hypot(torque), torque],
            ),
        }
    }

    fn tick(&mut self, frame: &SensorFrame, truth: &Truth) {
        let rover = &self.rover;
        let readings = Readings::new(frame, rover);
        let radius_m = rover.wheel.radius_m;
        let inverse_inertia = 1.0 / rover.drive.reflected_inertia_kg_m2;
        for ((wheel, rate), torque) in self.wheels.iter_mut().zip(readings.rates).zip(readings.torques) {
            let model = SlipTorqueModel { radius_m, inverse_inertia, motor_torque_nm: Some(torque) };
            wheel.tick(&model, [rate, readings.velocity[0]]);
        }
        let model = ContactAngleModel {
            side: RollingSide::new(rover),
            rim_speed_m_s: radius_m * readings.rates.iter().sum::<f64>() / 3.0,
            body_pitch: truth.pitch_rad.sin_cos(),
            body_rate_rad_s: readings.pitch_rate,
            sinking_rad: PerAxle::all(0.0),
        };
        let [forward, up] = readings.velocity;
        self.angles.tick(&model, [forward, up, readings.rocker, readings.bogie, readings.pitch]);
        let model = HubForceModel::new(&rover.suspension, readings.bogie.sin_cos());
        let body = body_moment_nm(rover, &readings.specific_force);
        let ([front, middle, rear], [on_front, on_middle, on_rear]) = (readings.cells, readings.torques);
        self.forces.tick(&model, [front, middle, rear, on_middle + on_rear, on_front - 0.5 * body]);
    }

    fn compare(&mut self) {
        self.wheels.iter_mut().for_each(Pair::compare);
        self.angles.compare();
        self.forces.compare();
    }
}

#[test]
fn discrete_and_continuous_filters_agree_within_two_percent_on_a_slow_traverse() {
    for scenario in [Scenario::Level, Scenario::Hills] {
        let options = Options { duration_s: Some(60.0), ..Options::default() };
        let drive = Traverse::new(scenario, 40, &Rover::assumed(), &options).expect("a drive");
        let mut side = Side::new(Rover::assumed());
        for (frame, truth) in drive.run().expect("frames") {
            let time_s = 1.0e-6 * frame.time_us as f64;
            if time_s >= ROLLING_S {
                side.tick(&frame, &truth);
            }
            if time_s >= STARTED_S {
                side.compare();
            }
        }
        for (wheel, name) in side.wheels.iter().zip(["front", "middle", "rear"]) {
            wheel.check(&format!("{scenario:?}, {name} wheel: rate, torque, slip"));
        }
        side.angles.check(&format!("{scenario:?}, ratio, contact angles, pitches"));
        side.forces.check(&format!("{scenario:?}, cells, along rocker and bogie"));
    }
}
