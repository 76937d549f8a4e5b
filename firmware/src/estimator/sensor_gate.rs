//! What is believed of a sensor before any filter sees it.

use super::health::{PerSensor, SensorHealth};
use crate::rover::{Axes, PerAxle, PerSide, PerWheel, Rover};
use crate::scalar::Scalar;

/// The same bits again for so many frames: no noisy sensor says that. One that is stuck and believed leads the filters astray.
const STUCK_FRAMES: u8 = 3;
/// A coarse sensor does say that. A repetition that ended by itself before it was thrice as long as any that was allowed so far is allowed
/// from then on, up to so many frames.
const MOST_STUCK_FRAMES: u8 = 12;
/// Bad readings in a row after which a sensor is out of use.
const DROPPED_AFTER: u8 = 10;
/// Good readings in a row that bring it back.
const PROBATION: u8 = 5;
/// The most that a rover does. Rims and the body move at so much, m/s; links lie at so much, rad, and the body turns at so much, rad/s.
const FASTEST_M_S: f32 = 2.0;
const STEEPEST_RAD: f32 = 1.6;
const FASTEST_TURN_RAD_S: f32 = 2.0;
/// A wheel bears so many times the rover's weight, and its drive so many times its torque at the rim; accelerometers feel so many g.
const MOST_WEIGHTS: f32 = 3.0;
const MOST_GRAVITIES: f32 = 5.0;

/// What a reading that goes on and on says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Nothing where it is zero, for what stands still may say so for long; else that the sensor is stuck.
    Motion,
    /// The same, or that a drive holds it constant: then it is used, as [repeating](SensorGates::repeating_rates), though counted.
    Regulated,
    /// That the sensor is stuck. An exact zero is no force but a dead channel, from the first on.
    Force,
}

/// The gate of one sensor.
#[derive(Debug, Clone, Copy)]
pub(super) struct SensorGate {
    /// Readings beyond this magnitude are absurd.
    limit: f32,
    last_bits: u32,
    repeats: u8,
    /// Repetitions that are allowed.
    allowed: u8,
    kind: Kind,
    bad: u8,
    good: u8,
}

impl SensorGate {
    const fn new(limit: f32) -> Self {
        Self { limit, last_bits: 0, repeats: 0, allowed: STUCK_FRAMES, kind: Kind::Motion, bad: 0, good: 0 }
    }

    /// One for each wheel, alike.
    #[inline(never)] // flash is scarcer than the time of a call
    fn of_wheels(limit: f32, kind: Kind) -> PerWheel<Self> {
        PerSide::both(PerAxle::all(Self { kind, ..Self::new(limit) }))
    }

    /// One for each axis, alike.
    #[inline(never)] // as above
    fn of_axes(limit: f32) -> Axes<Self> {
        let gate = Self::new(limit);
        Axes { x: gate, y: gate, z: gate }
    }

    /// The reading, if it can be used.
    fn admit(&mut self, reading: Option<f32>, health: &mut SensorHealth) -> Option<f32> {
        let Some(value) = reading else {
            count(&mut health.missing);
            return None;
        };
        let stuck = self.is_stuck(value);
        let reason = if !value.is_finite() {
            &mut health.not_finite
        } else if value.abs() > self.limit {
            &mut health.out_of_range
        } else if stuck {
            &mut health.stuck
        } else {
            return self.admit_good(value, health);
        };
        count(reason);
        if self.kind == Kind::Regulated && value.abs() <= self.limit {
            return self.admit_good(value, health);
        }
        self.good = 0;
        self.bad = self.bad.saturating_add(1);
        health.dropped |= self.bad >= DROPPED_AFTER;
        None
    }

    fn admit_good(&mut self, value: f32, health: &mut SensorHealth) -> Option<f32> {
        self.bad = 0;
        if !health.dropped {
            return Some(value);
        }
        self.good = self.good.saturating_add(1);
        if self.good < PROBATION {
            count(&mut health.on_probation);
            return None;
        }
        (health.dropped, self.good) = (false, 0);
        Some(value)
    }

    fn is_stuck(&mut self, value: f32) -> bool {
        let (bits, is_zero) = (value.to_bits(), value == 0.0);
        if bits == self.last_bits && !is_zero {
            self.repeats = self.repeats.saturating_add(1);
            return self.repeats >= self.allowed;
        }
        if self.repeats >= self.allowed && self.repeats < self.allowed.saturating_mul(3) {
            self.allowed = (self.repeats + 1).min(MOST_STUCK_FRAMES);
        }
        (self.repeats, self.last_bits) = (0, bits);
        is_zero && self.kind == Kind::Force
    }
}

/// Adds one to a count that stops at its greatest value.
pub(super) fn count(counter: &mut u16) {
    *counter = counter.saturating_add(1);
}

/// An encoder that says the same over and over is off by so many times its noise.
const REPEATING: f64 = 10.0;

/// Whether a sensor says the same bits as in the frame before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Repeats {
    /// It says something else.
    Not,
    /// It does, as one may that is coarse.
    Again,
    /// It has for as long as one that is stuck.
    OverAndOver,
}

impl Repeats {
    /// By how many times its noise an encoder is off that repeats so.
    pub fn of_noise<S: Scalar>(self) -> S {
        if self == Self::OverAndOver { S::constant(REPEATING) } else { S::one() }
    }
}

/// The gates of all sensors.
#[derive(Debug, Clone)]
pub struct SensorGates {
    gates: PerSensor<SensorGate>,
}

impl SensorGates {
    /// Gates for what this rover can do at most.
    pub fn new(rover: &Rover<f32>) -> Self {
        let most_n = MOST_WEIGHTS * (rover.mass_kg * rover.gravity_m_s2);
        let angle = SensorGate::new(STEEPEST_RAD);
        Self {
            gates: PerSensor {
                wheel_rate: SensorGate::of_wheels(FASTEST_M_S / rover.wheel.radius_m, Kind::Regulated),
                motor_torque: SensorGate::of_wheels(most_n * rover.wheel.radius_m, Kind::Force),
                load_cell: SensorGate::of_wheels(most_n, Kind::Force),
                bogie_angle: PerSide::both(angle),
                rocker_angle: angle,
                accel: SensorGate::of_axes(MOST_GRAVITIES * rover.gravity_m_s2),
                gyro: SensorGate::of_axes(FASTEST_TURN_RAD_S),
                velocity: SensorGate::of_axes(FASTEST_M_S),
            },
        }
    }

    /// Which encoders say the same bits over and over. That of a drive that holds its rate may well, if it is coarse; one that is stuck
    /// does, too, and nothing in it tells the two apart. To do without would be worse: it says nearly what the rate is while the drive
    /// goes on.
    pub(super) fn repeating_rates(&self) -> PerWheel<Repeats> {
        self.gates.wheel_rate.map_wheels(|gate| match gate.repeats {
            0 => Repeats::Not,
            repeats if repeats < gate.allowed => Repeats::Again,
            _ => Repeats::OverAndOver,
        })
    }

    /// The readings that can be used.
    pub fn admit(
        &mut self,
        readings: PerSensor<Option<f32>>,
        health: &mut PerSensor<SensorHealth>,
    ) -> PerSensor<Option<f32>> {
        self.gates
            .as_mut()
            .zip_map(health.as_mut(), |gate, health| (gate, health))
            .zip_map(readings, |(gate, health), reading| gate.admit(reading, health))
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, PROBATION, STUCK_FRAMES, SensorGate};
    use crate::estimator::SensorHealth;

    #[test]
    fn bad_readings_are_counted_by_reason_and_a_bad_sensor_comes_back_after_probation() {
        let (mut gate, mut health) = (SensorGate::new(10.0), SensorHealth::default());
        assert_eq!(gate.admit(Some(1.0), &mut health), Some(1.0));
        assert_eq!(gate.admit(None, &mut health), None);
        for bad in [f32::NAN, f32::INFINITY, 1.0e6, -11.0] {
            assert_eq!(gate.admit(Some(bad), &mut health), None);
        }
        assert_eq!((health.missing, health.not_finite, health.out_of_range), (1, 2, 2));
        assert_eq!(gate.admit(Some(2.0), &mut health), Some(2.0), "not dropped yet");
        for frame in 1..=30 {
            let admitted = gate.admit(Some(3.0), &mut health);
            assert_eq!(admitted.is_some(), frame <= STUCK_FRAMES, "frame {frame}");
        }
        assert!(health.dropped);
        for good in 0..PROBATION {
            let admitted = gate.admit(Some(3.1 + f32::from(good)), &mut health);
            assert_eq!(admitted.is_some(), good + 1 == PROBATION);
        }
        assert!(!health.dropped);
    }

    /// A coarse sensor says the same for some frames now and then; the longest of these is not taken for a failure the next time.
    #[test]
    fn a_coarse_sensor_is_not_taken_for_a_stuck_one_for_ever() {
        let (mut gate, mut health) = (SensorGate::new(10.0), SensorHealth::default());
        let stuck = |gate: &mut SensorGate, health: &mut SensorHealth, value: f32, frames: usize| {
            let before = health.stuck;
            (0..frames).for_each(|_| {
                gate.admit(Some(value), health);
            });
            health.stuck - before
        };
        assert_eq!(stuck(&mut gate, &mut health, 1.0, 6), 3);
        assert_eq!(stuck(&mut gate, &mut health, 1.1, 6), 0, "six readings alike are allowed");
        assert_eq!(stuck(&mut gate, &mut health, 1.2, 7), 1, "not a seventh");
        assert_eq!(stuck(&mut gate, &mut health, 1.3, 40), 33, "for so long it is stuck");
        assert_eq!(stuck(&mut gate, &mut health, 1.4, 8), 1, "and that does not make it a coarse one");
    }

    /// One that is read several times for each of its own readings comes back after a failure, however often it is read.
    #[test]
    fn a_sensor_that_is_held_comes_back_after_a_failure() {
        for held in 1..=usize::from(3 * STUCK_FRAMES) {
            let (mut gate, mut health) = (SensorGate::new(100.0), SensorHealth::default());
            let mut used = |value: f32| (0..held).filter(|_| gate.admit(Some(value), &mut health).is_some()).count();
            (1..=20_u8).for_each(|value| {
                used(value.into());
            });
            (0..20).for_each(|_| {
                used(f32::NAN);
            });
            let again = (21..=40_u8).map(|value| used(value.into())).last();
            assert_eq!(again, Some(held), "held for {held} frames");
        }
    }

    /// What stands says zero for long, and what is dead from the first time on.
    #[test]
    fn zero_is_no_force() {
        for (kind, used, stuck) in [(Kind::Motion, 40, 0), (Kind::Regulated, 40, 0), (Kind::Force, 0, 40)] {
            let (mut gate, mut health) = (SensorGate { kind, ..SensorGate::new(10.0) }, SensorHealth::default());
            let admitted = (0..40).filter(|_| gate.admit(Some(0.0), &mut health).is_some()).count();
            assert_eq!((admitted, health.stuck), (used, stuck), "{kind:?}");
        }
    }

    /// An encoder that says the same is used, and counted; not one that says NaN or absurd numbers over and over.
    #[test]
    fn a_drive_that_holds_its_rate_is_believed() {
        let (mut gate, mut health) =
            (SensorGate { kind: Kind::Regulated, ..SensorGate::new(10.0) }, SensorHealth::default());
        for (value, used) in [(0.3, true), (f32::NAN, false), (1.0e6, false)] {
            assert!((0..20).all(|_| gate.admit(Some(value), &mut health).is_some() == used), "{value}");
        }
        assert_eq!((health.stuck, health.not_finite, health.out_of_range), (17, 20, 20));
    }
}
