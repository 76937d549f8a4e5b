//! The estimators of the whole rover: a frame in, the state of every wheel out.

use super::attitude::{Attitude, Contradicted};
use super::estimate::SideEstimate;
use super::health::{EstimatorHealth, PerSensor, SensorHealth};
use super::sensor_gate::{Repeats, SensorGates, count};
use super::side_estimate::{Believed, HubForces, WheelCovariance};
use super::side_estimator::{SideEstimator, SideInnovations};
use super::side_frame::SideFrame;
use super::surprise::{Surprises, WheelSurprises};
use super::troubles::Troubles;
use super::whole_balance::{Steadiness, balanced};
use crate::rover::{PerSide, PerWheel, Rover, Side};
use crate::scalar::Scalar;
use crate::sensor_frame::SensorFrame;

/// After a gap this long the filters start anew, µs.
pub const GAP_US: u64 = 5_000_000;
/// So many frames from the past, without a newer one between, mean that the clock was set back.
const CLOCK_SET_BACK: u8 = 8;
/// What the costly work of each side begins with, so that it is spread over frames.
const PHASES: PerSide<usize> = PerSide { left: 0, right: 3 };

/// The estimators of a rover.
#[derive(Debug, Clone)]
pub struct RoverEstimator<S> {
    common: Common<S>,
    /// None until it has begun.
    sides: PerSide<Option<SideEstimator<S>>>,
    estimates: PerSide<SideEstimate>,
}

/// What is known of the rover as a whole.
#[derive(Debug, Clone)]
struct Common<S> {
    rover: Rover<S>,
    gates: SensorGates,
    attitude: Attitude<S>,
    health: EstimatorHealth,
    troubles_before: Troubles,
    last_time_us: Option<u64>,
    from_the_past: u8,
}

impl<S: Scalar> Common<S> {
    #[inline(never)] // flash is scarcer than the time of a call
    fn new(rover: &Rover<S>) -> Self {
        Self {
            rover: *rover,
            gates: SensorGates::new(&rover.map(Scalar::to_f32)),
            attitude: Attitude::new(rover.gravity_m_s2),
            health: EstimatorHealth::NOTHING,
            troubles_before: Troubles::default(),
            last_time_us: None,
            from_the_past: 0,
        }
    }

    /// The forces on the hubs of both sides as they hold the rover together.
    fn balanced(&self, sides: &PerSide<&SideEstimator<S>>) -> PerSide<HubForces<S>> {
        let either = |is_so: fn(&SideEstimator<S>) -> bool| is_so(sides.left) || is_so(sides.right);
        let steadiness = if either(|side| side.joints().are_surmised()) {
            Steadiness::Unknown
        } else if either(|side| !side.is_steady()) {
            Steadiness::Unsteady
        } else {
            Steadiness::Steady
        };
        balanced(&self.rover, &self.attitude, steadiness, &sides.map(SideEstimator::forces))
    }
}

/// What became of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Taken {
    /// It is in the estimate; travel of the ends of the axis since the one before, m.
    Used(f32),
    /// It repeats the time of the one before, or is from before that.
    LeftOut,
}

impl<S: Scalar> RoverEstimator<S> {
    /// Estimators for a rover that was just switched on and passes [`Rover::check`]; of another, estimates mean nothing.
    pub fn new(rover: &Rover<S>) -> Self {
        let mut estimator = Self::not_begun(rover);
        estimator.restart(rover);
        estimator
    }

    /// Estimators that take no frame until [`Self::restart`]: what is large about them is made where it stays, for two do not fit on the
    /// stack.
    pub fn not_begun(rover: &Rover<S>) -> Self {
        Self { common: Common::new(rover), sides: PerSide { left: None, right: None }, estimates: PerSide::default() }
    }

    /// Starts anew, for another rover, where this one is.
    pub fn restart(&mut self, rover: &Rover<S>) {
        self.start_sides(rover);
        self.common = Common::new(rover);
        self.estimates = PerSide::default();
    }

    fn start_sides(&mut self, rover: &Rover<S>) {
        start_side(&mut self.sides.left, rover, Side::Left);
        start_side(&mut self.sides.right, rover, Side::Right);
    }

    /// Takes a frame.
    pub fn tick(&mut self, frame: &SensorFrame) -> Taken {
        let Some(step_s) = self.step_s(frame.time_us) else { return Taken::LeftOut };
        let PerSide { left: Some(left_side), right: Some(right_side) } = &mut self.sides else { return Taken::LeftOut };
        self.common.health.frames = self.common.health.frames.saturating_add(1);
        let readings = self.common.gates.admit(frame.readings(), &mut self.common.health.sensors);
        let readings = readings.map(|reading| reading.map(S::from_f32));
        let speed = readings.velocity.x;
        let noise = &self.common.rover.noise;
        let contradicted = self.common.attitude.tick(readings.accel, readings.gyro, speed, step_s, noise);
        let PerSensor { accel, gyro, .. } = &mut self.common.health.sensors;
        match contradicted {
            Some(Contradicted::Accelerometer) => {
                [&mut accel.x, &mut accel.z].into_iter().for_each(|sensor| count(&mut sensor.surprising));
            }
            Some(Contradicted::Gyro) => count(&mut gyro.y.surprising),
            None => {}
        }
        let repeating = self.common.gates.repeating_rates();
        let rover_gained = rover_gained(left_side, right_side);
        let frame_of = |side: Side| side_frame(&readings, &repeating, side, rover_gained);
        let left = left_side.tick(step_s, &frame_of(Side::Left), &self.common.attitude);
        let right = right_side.tick(step_s, &frame_of(Side::Right), &self.common.attitude);
        let travel_m = S::constant(0.5) * (left_side.speed_m_s() + right_side.speed_m_s()) * step_s;
        note_surprises(&mut self.common.health.sensors, &PerSide { left, right });
        self.note_troubles();
        self.estimate_sides();
        Taken::Used(travel_m.to_f32())
    }

    /// What is known of the sides since the last frame that was used; before the first one, nothing.
    pub fn estimate(&self) -> &PerSide<SideEstimate> {
        &self.estimates
    }

    /// How the errors of each wheel's estimates belong together.
    pub fn covariances(&self) -> Option<PerWheel<WheelCovariance<S>>> {
        self.of_sides(SideEstimator::covariances)
    }

    /// What the filters state of their errors, which [`Self::covariances`] does not take as it is.
    pub fn believed(&self) -> Option<PerSide<Believed<S>>> {
        self.of_sides(SideEstimator::believed)
    }

    /// Of both sides, with the forces on their hubs as they hold the rover together.
    fn of_sides<U>(&self, of: impl Fn(&SideEstimator<S>, &HubForces<S>) -> U) -> Option<PerSide<U>> {
        let sides = self.begun()?;
        Some(sides.zip(self.common.balanced(&sides)).map(|(side, forces)| of(side, &forces)))
    }

    fn begun(&self) -> Option<PerSide<&SideEstimator<S>>> {
        let PerSide { left, right } = &self.sides;
        Some(PerSide { left: left.as_ref()?, right: right.as_ref()? })
    }

    fn estimate_sides(&mut self) {
        let PerSide { left: Some(left), right: Some(right) } = &mut self.sides else { return };
        let forces = self.common.balanced(&PerSide { left, right });
        self.estimates.left = left.estimate(&forces.left);
        self.estimates.right = right.estimate(&forces.right);
    }

    /// What the measurements told the filters in the last frame.
    pub fn innovations(&self) -> Option<PerSide<&SideInnovations<S>>> {
        Some(self.begun()?.map(SideEstimator::innovations))
    }

    /// Pitch of the body in the plane of its sides, rad, nose-up.
    pub fn pitch_rad(&self) -> S {
        self.common.attitude.pitch_rad()
    }

    /// One standard deviation of that, rad.
    pub fn pitch_std_rad(&self) -> S {
        self.common.attitude.pitch_variance().sqrt()
    }

    /// Which sides roll back.
    pub fn rolls_back(&self) -> PerSide<bool> {
        self.sides.as_ref().map(|side| side.as_ref().is_some_and(SideEstimator::rolls_back))
    }

    /// Whether the rocker's angle, or how fast the axis rises, is surmised, because nothing has told it for a second: then all contacts of a
    /// side are off alike, and for long.
    pub fn surmises_contacts(&self) -> bool {
        self.sides.as_array().into_iter().flatten().any(|side| side.joints().lack_what_tells_all())
    }

    /// How sensors and filters do.
    pub fn health(&self) -> &EstimatorHealth {
        &self.common.health
    }

    /// Seconds since the frame before; none for a frame that is to be left out. Zero for the first one, and for one after a long gap, or after
    /// a clock was set back, with which the filters start anew.
    fn step_s(&mut self, time_us: u64) -> Option<S> {
        let Some(last) = self.common.last_time_us else {
            self.common.last_time_us = Some(time_us);
            return Some(S::zero());
        };
        if time_us == last {
            self.common.health.repeated_frames = self.common.health.repeated_frames.saturating_add(1);
            return None;
        }
        if time_us < last {
            self.common.health.backward_frames = self.common.health.backward_frames.saturating_add(1);
            self.common.from_the_past = self.common.from_the_past.saturating_add(1);
            if self.common.from_the_past < CLOCK_SET_BACK {
                return None;
            }
        }
        self.common.from_the_past = 0;
        self.common.last_time_us = Some(time_us);
        let step_us = time_us.checked_sub(last).filter(|step| *step <= GAP_US);
        let Some(step_us) = step_us.and_then(|step| u32::try_from(step).ok()) else {
            self.start_anew();
            return Some(S::zero());
        };
        Some(S::from_f32(step_us as f32 * 1.0e-6))
    }

    /// Starts the filters anew after a long gap, or after a clock was set back. Both count as a gap.
    fn start_anew(&mut self) {
        self.common.health.gaps = self.common.health.gaps.saturating_add(1);
        self.common.attitude = Attitude::new(self.common.rover.gravity_m_s2);
        let rover = self.common.rover;
        self.start_sides(&rover);
        self.common.troubles_before = Troubles::default();
    }

    /// Adds what the filters counted since the frame before.
    fn note_troubles(&mut self) {
        let of_sides = self.sides.as_array().into_iter().flatten().map(SideEstimator::troubles);
        let now = of_sides.fold(Troubles::default(), Troubles::plus);
        let new = now.since(core::mem::replace(&mut self.common.troubles_before, now));
        let health = &mut self.common.health;
        health.filter_resets = health.filter_resets.saturating_add(new.resets);
        health.relearned = health.relearned.saturating_add(new.relearned);
    }
}

/// Never inlined: a side that is being made takes kilobytes, which the stack frame of a caller would keep.
#[inline(never)]
fn start_side<S: Scalar>(place: &mut Option<SideEstimator<S>>, rover: &Rover<S>, side: Side) {
    *place = Some(SideEstimator::new(rover, side, *PHASES.of(side)));
}

/// The share of its speed that the rover gained in the frame before: the mean over its wheels, each by how much it holds the rover.
fn rover_gained<S: Scalar>(left: &SideEstimator<S>, right: &SideEstimator<S>) -> S {
    let ([left_holds, of_left], [right_holds, of_right]) = (left.gained(), right.gained());
    (of_left + of_right) / (left_holds + right_holds).max(S::constant(1.0e-3))
}

fn side_frame<S: Scalar>(
    readings: &PerSensor<Option<S>>,
    repeating: &PerWheel<Repeats>,
    side: Side,
    rover_gained: S,
) -> SideFrame<S> {
    SideFrame {
        wheel_rate_rad_s: *readings.wheel_rate.of(side),
        wheel_rate_repeats: *repeating.of(side),
        motor_torque_nm: *readings.motor_torque.of(side),
        load_cell_n: *readings.load_cell.of(side),
        bogie_angle_rad: *readings.bogie_angle.of(side),
        rocker_angle_rad: readings.rocker_angle.map(|angle| match side {
            Side::Left => angle,
            Side::Right => -angle,
        }),
        velocity_m_s: readings.velocity,
        gyro_rad_s: readings.gyro,
        rover_gained,
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
    count_wheels(&mut sensors.wheel_rate, &wheels, |wheel| wheel.wheel_rate);
    count_wheels(&mut sensors.motor_torque, &wheels, |wheel| wheel.motor_torque);
    count_wheels(&mut sensors.load_cell, &wheels, |wheel| wheel.load_cell);
}

/// Counts a sensor of the wheels where it surprised.
fn count_wheels(
    sensors: &mut PerWheel<SensorHealth>,
    wheels: &PerWheel<WheelSurprises>,
    surprised: impl Fn(&WheelSurprises) -> bool,
) {
    let each = sensors.iter_wheels_mut().zip(wheels.iter_wheels());
    each.filter(|(_, wheel)| surprised(wheel)).for_each(|(sensor, _)| count(&mut sensor.surprising));
}
