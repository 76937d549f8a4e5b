//! The estimators of the whole rover: a frame in, the state of every wheel out.

use super::attitude::Attitude;
use super::estimate::SideEstimate;
use super::health::{EstimatorHealth, PerSensor, SensorHealth};
use super::hub_force;
use super::sensor_gate::{SensorGates, count};
use super::side_estimate::WheelCovariance;
use super::side_estimator::{SideEstimator, SideFrame, SideInnovations};
use super::surprise::Surprises;
use super::whole_balance::balanced;
use crate::filter::{Gaussian, InvalidNumber};
use crate::rover::{PerSide, PerWheel, Rover, Side};
use crate::scalar::Scalar;
use crate::sensor_frame::SensorFrame;

/// After a gap this long the filters start anew, µs.
const GAP_US: u64 = 5_000_000;
/// So many frames in a row from the past mean that the clock was set back.
const CLOCK_SET_BACK: u8 = 8;
/// What the costly work of each side begins with, so that it is spread over frames.
const PHASES: PerSide<usize> = PerSide { left: 0, right: 3 };

/// The estimators of a rover.
#[derive(Debug, Clone)]
pub struct RoverEstimator<S> {
    rover: Rover<S>,
    gates: SensorGates,
    attitude: Attitude<S>,
    sides: PerSide<SideEstimator<S>>,
    health: EstimatorHealth,
    troubles_before: (u32, u32),
    last_time_us: Option<u64>,
    from_the_past: u8,
}

/// What became of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Taken {
    /// It is in the estimate; travel of the rims since the one before, m.
    Used(f32),
    /// It repeats the time of the one before, or is from before that.
    LeftOut,
}

impl<S: Scalar> RoverEstimator<S> {
    /// Estimators for a rover that was just switched on. The `flight` rover has the same numbers in single precision; the
    /// gates compare readings as they come.
    ///
    /// # Errors
    /// Where a number of the rover is not finite.
    pub fn new(rover: &Rover<S>) -> Result<Self, InvalidNumber> {
        Ok(Self {
            rover: *rover,
            gates: SensorGates::new(&rover.map(Scalar::to_f32)),
            attitude: Attitude::new(rover.gravity_m_s2),
            sides: PerSide {
                left: SideEstimator::new(rover, Side::Left, PHASES.left)?,
                right: SideEstimator::new(rover, Side::Right, PHASES.right)?,
            },
            health: EstimatorHealth::default(),
            troubles_before: (0, 0),
            last_time_us: None,
            from_the_past: 0,
        })
    }

    /// Starts anew, for another rover, where this one is: two estimators do not fit on the stack.
    ///
    /// # Errors
    /// Where a number of the rover is not finite. Then nothing has changed.
    pub fn restart(&mut self, rover: &Rover<S>) -> Result<(), InvalidNumber> {
        self.start_sides(rover)?;
        self.rover = *rover;
        self.gates = SensorGates::new(&rover.map(Scalar::to_f32));
        self.attitude = Attitude::new(rover.gravity_m_s2);
        self.health = EstimatorHealth::default();
        self.troubles_before = (0, 0);
        self.last_time_us = None;
        self.from_the_past = 0;
        Ok(())
    }

    fn start_sides(&mut self, rover: &Rover<S>) -> Result<(), InvalidNumber> {
        start_side(&mut self.sides.left, rover, Side::Left)?;
        // The same numbers.
        start_side(&mut self.sides.right, rover, Side::Right)
    }

    /// Takes a frame.
    pub fn tick(&mut self, frame: &SensorFrame) -> Taken {
        let Some(step_s) = self.step_s(frame.time_us) else { return Taken::LeftOut };
        self.health.frames = self.health.frames.saturating_add(1);
        let readings = self.gates.admit(frame.readings(), &mut self.health.sensors);
        let readings = readings.map(|reading| reading.map(S::from_f32));
        if self.attitude.tick(readings.accel, readings.gyro, step_s, &self.rover.noise) {
            let accel = &mut self.health.sensors.accel;
            [&mut accel.x, &mut accel.z].into_iter().for_each(|sensor| count(&mut sensor.surprising));
        }
        let left = self.sides.left.tick(step_s, &side_frame(&readings, Side::Left), &self.attitude);
        let right = self.sides.right.tick(step_s, &side_frame(&readings, Side::Right), &self.attitude);
        note_surprises(&mut self.health.sensors, &PerSide { left, right });
        self.note_troubles();
        Taken::Used(self.travel_m(step_s).to_f32())
    }

    fn travel_m(&self, step_s: S) -> S {
        let PerSide { left, right } = self.sides.as_ref().map(SideEstimator::speed_m_s);
        S::constant(0.5) * (left + right) * step_s
    }

    /// What is known of the sides.
    pub fn estimate(&self) -> PerSide<SideEstimate> {
        let forces = self.balanced();
        self.sides.as_ref().zip(forces).map(|(side, forces)| side.estimate(&forces))
    }

    /// How the errors of each wheel's estimates belong together.
    pub fn covariances(&self) -> PerWheel<WheelCovariance<S>> {
        let forces = self.balanced();
        self.sides.as_ref().zip(forces).map(|(side, forces)| side.covariances(&forces))
    }

    /// The forces on the hubs of both sides, as they hold the rover together.
    fn balanced(&self) -> PerSide<Gaussian<S, { hub_force::STATES }>> {
        let sides = self.sides.as_ref().map(SideEstimator::forces);
        let steady = self.sides.as_array().into_iter().all(SideEstimator::is_steady);
        balanced(&self.rover, &self.attitude, steady, &sides)
    }

    /// What the measurements told the filters in the last frame.
    pub fn innovations(&self) -> PerSide<&SideInnovations<S>> {
        self.sides.as_ref().map(SideEstimator::innovations)
    }

    /// Pitch of the body in the plane of its sides, rad, nose-up.
    pub fn pitch_rad(&self) -> S {
        self.attitude.pitch_rad()
    }

    /// One standard deviation of that, rad.
    pub fn pitch_std_rad(&self) -> S {
        self.attitude.pitch_variance().sqrt()
    }

    /// How sensors and filters do.
    pub fn health(&self) -> &EstimatorHealth {
        &self.health
    }

    /// Seconds since the frame before; none for a frame that is to be left out.
    fn step_s(&mut self, time_us: u64) -> Option<S> {
        let Some(last) = self.last_time_us else {
            self.last_time_us = Some(time_us);
            return Some(S::zero());
        };
        if time_us == last {
            self.health.repeated_frames = self.health.repeated_frames.saturating_add(1);
            return None;
        }
        if time_us < last {
            self.health.backward_frames = self.health.backward_frames.saturating_add(1);
            self.from_the_past = self.from_the_past.saturating_add(1);
            if self.from_the_past < CLOCK_SET_BACK {
                return None;
            }
        }
        self.from_the_past = 0;
        self.last_time_us = Some(time_us);
        let step_us = time_us.checked_sub(last).filter(|step| *step <= GAP_US);
        let Some(step_us) = step_us.and_then(|step| u32::try_from(step).ok()) else {
            self.start_anew();
            return Some(S::zero());
        };
        Some(S::from_f32(step_us as f32 * 1.0e-6))
    }

    fn start_anew(&mut self) {
        self.health.gaps = self.health.gaps.saturating_add(1);
        self.attitude = Attitude::new(self.rover.gravity_m_s2);
        // The same rover made the filters that are there.
        let rover = self.rover;
        let _ = self.start_sides(&rover);
        self.troubles_before = (0, 0);
    }

    /// Adds what the filters counted since the frame before.
    fn note_troubles(&mut self) {
        let (left, right) = (self.sides.left.troubles(), self.sides.right.troubles());
        let now = (left.0.saturating_add(right.0), left.1.saturating_add(right.1));
        let before = core::mem::replace(&mut self.troubles_before, now);
        let health = &mut self.health;
        health.filter_resets = health.filter_resets.saturating_add(now.0.saturating_sub(before.0));
        health.relearned = health.relearned.saturating_add(now.1.saturating_sub(before.1));
    }
}

/// Never inlined: a side that is being made takes kilobytes, which the stack frame of a caller would keep.
#[inline(never)]
fn start_side<S: Scalar>(place: &mut SideEstimator<S>, rover: &Rover<S>, side: Side) -> Result<(), InvalidNumber> {
    SideEstimator::new(rover, side, *PHASES.of(side)).map(|anew| *place = anew)
}

fn side_frame<S: Scalar>(readings: &PerSensor<Option<S>>, side: Side) -> SideFrame<S> {
    SideFrame {
        wheel_rate_rad_s: *readings.wheel_rate.of(side),
        motor_torque_nm: *readings.motor_torque.of(side),
        load_cell_n: *readings.load_cell.of(side),
        bogie_angle_rad: *readings.bogie_angle.of(side),
        rocker_angle_rad: readings.rocker_angle.map(|angle| match side {
            Side::Left => angle,
            Side::Right => -angle,
        }),
        velocity_m_s: readings.velocity,
        gyro_rad_s: readings.gyro,
    }
}

/// Counts a sensor once a frame, whichever filters it surprised.
fn note_surprises(sensors: &mut PerSensor<SensorHealth>, surprises: &PerSide<Surprises>) {
    let either = |by: fn(&Surprises) -> bool| by(&surprises.left) || by(&surprises.right);
    let hub_speeds = |side: &Surprises| side.wheels.as_array().into_iter().all(|wheel| wheel.hub_speed);
    let shared = [
        (&mut sensors.velocity.x, either(|side| side.velocity_x) || surprises.as_array().into_iter().all(hub_speeds)),
        (&mut sensors.velocity.z, either(|side| side.velocity_z)),
        (&mut sensors.rocker_angle, either(|side| side.rocker_angle)),
        (&mut sensors.bogie_angle.left, surprises.left.bogie_angle),
        (&mut sensors.bogie_angle.right, surprises.right.bogie_angle),
    ];
    shared.into_iter().filter(|(_, surprised)| *surprised).for_each(|(sensor, _)| count(&mut sensor.surprising));
    let wheels = surprises.as_ref().map(|side| side.wheels);
    for (sensor, surprised) in sensors.wheel_rate.iter_wheels_mut().zip(wheels.iter_wheels()) {
        if surprised.wheel_rate {
            count(&mut sensor.surprising);
        }
    }
    for (sensor, surprised) in sensors.load_cell.iter_wheels_mut().zip(wheels.iter_wheels()) {
        if surprised.load_cell {
            count(&mut sensor.surprising);
        }
    }
}
