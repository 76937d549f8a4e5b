//! How the rover stands against the vertical.

use super::scalar_filter::ScalarFilter;
use crate::rover::{Axes, SensorNoise};
use crate::scalar::Scalar;

/// The tilt of the body in the plane of its sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attitude<S> {
    pitch: ScalarFilter<S>,
    /// How many frames in a row the accelerometer contradicted what the gyro said.
    contradictions: u8,
    /// The last specific force that was believed, turned to the pitch of now, m/s².
    specific_force: Axes<S>,
    /// Rate of the pitch that the gyro tells, rad/s, with its standard deviation.
    rate_rad_s: (S, S),
    /// The pitch that the accelerometer alone felt in the last frame, rad, and its standard deviation.
    felt_rad: Option<S>,
    felt_std_rad: S,
    /// The last speed forward that was measured, m/s, and the time since, s.
    speed_m_s: Option<S>,
    since_s: S,
}

/// An inertial sensor that says what the other and the pitch before speak against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Contradicted {
    /// It feels something else than gravity.
    Accelerometer,
    /// Its rate jumped for a frame.
    Gyro,
}

/// How far the accelerometer may be from what the gyro says, in variances, before it is thought to feel something else
/// than gravity; and for how many frames.
const GATE: f64 = 16.0;
const PATIENCE: u8 = 8;
/// What the rover may accelerate at as it is first seen, m/s²: it may have just started.
const UNSEEN_ACCELERATION: f64 = 0.5;
/// A change of the measured speed up to this many of its standard deviations is taken for noise.
const SPEED_NOISE: f64 = 4.0;
/// One standard deviation of the pitch of a rover that stands somewhere, rad.
const STEEP: f64 = 0.2;
/// A pitch of a greater standard deviation is lost, rad. One standard deviation with which angles are told against the gyro where nothing was
/// felt ever, rad; and the variance of a specific force that is not to be believed, (m/s²)².
const LOST: f64 = 0.01;
const AGAINST_GYRO: f64 = 2.0e-3;
const NOT_TO_BE_BELIEVED: f64 = 1.0e6;
/// A rover that stands or drives feels more than this along its upright, m/s².
const LEAST_UPRIGHT_M_S2: f64 = 0.5;
/// What the rover may turn at without a gyro to tell, rad/s.
const UNSEEN_TURN: f64 = 0.05;

impl<S: Scalar> Attitude<S> {
    /// Nothing is known: level, within a radian.
    pub fn new(gravity_m_s2: S) -> Self {
        let specific_force = Axes { x: S::zero(), y: S::zero(), z: gravity_m_s2 };
        Self {
            pitch: ScalarFilter { mean: S::zero(), variance: S::one() },
            contradictions: 0,
            specific_force,
            rate_rad_s: (S::zero(), S::one()),
            felt_rad: None,
            felt_std_rad: S::constant(AGAINST_GYRO),
            speed_m_s: None,
            since_s: S::zero(),
        }
    }

    /// Pitch of the body in the plane of its sides against the level line of that plane, rad.
    pub fn pitch_rad(&self) -> S {
        self.pitch.mean
    }

    /// Its variance, rad².
    pub fn pitch_variance(&self) -> S {
        self.pitch.variance
    }

    /// The same where the accelerometer could not be used in the last frame, up to what slopes a rover stands on; else nothing.
    pub fn unfelt_variance(&self) -> S {
        match self.felt_rad {
            Some(_) => S::zero(),
            None => self.pitch.variance.min(S::constant(STEEP * STEEP)),
        }
    }

    /// Rate of the pitch that the gyro tells, rad/s, nose-up, and its standard deviation.
    pub fn rate_rad_s(&self) -> (S, S) {
        self.rate_rad_s
    }

    /// The pitch that the accelerometer alone felt in the last frame, rad; none where it could not be used; and its standard deviation. Where it
    /// was not felt for so long that hardly anything is known of it, that of the gyro: all angles are told against it then, and err alike.
    pub fn felt_rad(&self) -> (Option<S>, S) {
        (if self.is_lost() { Some(self.pitch.mean) } else { self.felt_rad }, self.felt_std_rad)
    }

    /// Whether the pitch was not felt for so long, or never.
    fn is_lost(&self) -> bool {
        self.felt_rad.is_none() && self.pitch.variance > S::constant(LOST * LOST)
    }

    /// The specific force, m/s²: as it is felt, or as the pitch says.
    pub fn specific_force_m_s2(&self) -> &Axes<S> {
        &self.specific_force
    }

    /// Variance of it along and across the body in the plane of the sides, (m/s²)², with an accelerometer of such noise, m/s². What follows from
    /// a pitch that is lost errs alike in all frames, and is not to be believed in any.
    pub fn force_variance(&self, noise_m_s2: S) -> S {
        if self.is_lost() {
            return S::constant(NOT_TO_BE_BELIEVED);
        }
        let Axes { x, z, .. } = self.specific_force;
        let turned = if self.felt_rad.is_some() { S::zero() } else { (x * x + z * z) * self.pitch.variance };
        noise_m_s2 * noise_m_s2 + turned
    }

    /// Takes the inertial sensors' readings and the speed forward. Gives which of them was surprising.
    pub fn tick(
        &mut self,
        accel: Axes<Option<S>>,
        gyro: Axes<Option<S>>,
        speed_m_s: Option<S>,
        step_s: S,
        noise: &SensorNoise<S>,
    ) -> Option<Contradicted> {
        self.felt_rad = None;
        let (rate_before, _) = self.rate_rad_s;
        self.turn(gyro, step_s, noise.gyro_rad_s);
        let accelerates = self.accelerates(speed_m_s, step_s, noise.velocity_m_s);
        let Axes { x: Some(x), y, z: Some(z) } = accel else {
            self.carry_force();
            return None;
        };
        if z < S::constant(LEAST_UPRIGHT_M_S2) {
            self.carry_force();
            return Some(Contradicted::Accelerometer);
        }
        let in_plane = (x * x + z * z).sqrt();
        let angle = S::constant(core::f64::consts::FRAC_PI_2) - (x / in_plane).acos();
        let noise = (noise.accel_m_s2 * noise.accel_m_s2 + accelerates * accelerates).sqrt() / in_plane;
        let innovation = angle - self.pitch.mean;
        let variance = self.pitch.variance + noise * noise;
        let is_beyond = |innovation: S| innovation * innovation > S::constant(GATE) * variance;
        let jumped = step_s * (self.rate_rad_s.0 - rate_before);
        let of_gyro = is_beyond(innovation) && !is_beyond(innovation + jumped);
        if of_gyro {
            self.turn_as_before(rate_before, jumped, step_s);
        }
        let surprising = is_beyond(innovation) && !of_gyro;
        if surprising && self.contradictions < PATIENCE {
            self.contradictions += 1;
            self.carry_force();
            return Some(Contradicted::Accelerometer);
        }
        if surprising {
            self.pitch.variance = innovation * innovation;
        }
        self.contradictions = 0;
        self.specific_force = Axes { x, y: y.unwrap_or(self.specific_force.y), z };
        (self.felt_rad, self.felt_std_rad) = (Some(angle), noise);
        let _ = self.pitch.update(angle, noise * noise);
        match (surprising, of_gyro) {
            (true, _) => Some(Contradicted::Accelerometer),
            (false, true) => Some(Contradicted::Gyro),
            (false, false) => None,
        }
    }

    /// The accelerometer bears out the rate of the frame before, rad/s, and not the angle by which the gyro has jumped since, rad.
    fn turn_as_before(&mut self, rate_rad_s: S, jumped_rad: S, step_s: S) {
        let std = S::constant(UNSEEN_TURN);
        self.rate_rad_s = (rate_rad_s, std);
        self.pitch.mean -= jumped_rad;
        self.pitch.variance += step_s * step_s * std * std;
    }

    /// Turns what was felt last to where the pitch is now: it stands until the accelerometer is believed again.
    fn carry_force(&mut self) {
        let Axes { x, z, .. } = self.specific_force;
        let in_plane = (x * x + z * z).sqrt();
        let (sine, cosine) = self.pitch.mean.sin_cos();
        (self.specific_force.x, self.specific_force.z) = (in_plane * sine, in_plane * cosine);
    }

    /// How fast the rover speeds up or slows down, m/s², beyond what noise of the velocimeter may be: the accelerometer feels that as well,
    /// and it is no tilt.
    fn accelerates(&mut self, speed_m_s: Option<S>, step_s: S, noise_m_s: S) -> S {
        self.since_s += step_s;
        let (before, since) = (self.speed_m_s, self.since_s);
        if speed_m_s.is_some() {
            (self.speed_m_s, self.since_s) = (speed_m_s, S::zero());
        }
        match before.zip(speed_m_s) {
            Some((before, now)) if since > S::zero() => {
                ((now - before).abs() - S::constant(SPEED_NOISE) * noise_m_s).max(S::zero()) / since
            }
            _ if self.pitch.variance >= S::one() => S::constant(UNSEEN_ACCELERATION),
            _ => S::zero(),
        }
    }

    /// Carries the pitch along: the rate at which gravity turns in the plane, of a body that turns about all axes.
    fn turn(&mut self, gyro: Axes<Option<S>>, step_s: S, noise_rad_s: S) {
        let known = gyro.y.is_some();
        let turn = gyro.map(|rate| rate.unwrap_or(S::zero()));
        let rate_std = if known { noise_rad_s } else { S::constant(UNSEEN_TURN) };
        self.rate_rad_s = (pitch_rate(turn, self.specific_force), rate_std);
        self.pitch.mean += step_s * self.rate_rad_s.0;
        let drift = step_s * rate_std;
        self.pitch.variance = (self.pitch.variance + drift * drift).min(S::one());
    }
}

/// How fast gravity turns nose-up in the plane of the sides, rad/s, where a body turns at these rates, rad/s, and this is felt: one that leans
/// to a side pitches by yawing.
pub fn pitch_rate<S: Scalar>(turn: Axes<S>, felt: Axes<S>) -> S {
    let Axes { x, y, z } = felt;
    let in_plane_squared = x * x + z * z;
    let coupling =
        if in_plane_squared > S::zero() { y * (turn.z * z + turn.x * x) / in_plane_squared } else { S::zero() };
    coupling - turn.y
}

#[cfg(test)]
mod tests {
    use super::{Attitude, Contradicted};
    use crate::rover::{Axes, Rover};

    /// On level ground, ten frames a second: the pitch after each frame of a rover that moves at these speeds, m/s.
    fn pitches<const N: usize>(speeds: [f64; N]) -> [f64; N] {
        let noise = Rover::<f64>::assumed().noise;
        let mut attitude = Attitude::new(9.81);
        let mut before = 0.0;
        speeds.map(|speed| {
            let accel = Axes { x: Some((speed - before) / 0.1), y: Some(0.0), z: Some(9.81) };
            before = speed;
            let gyro = Axes { x: Some(0.0), y: Some(0.0), z: Some(0.0) };
            let surprised = attitude.tick(accel, gyro, Some(speed), 0.1, &noise);
            assert_eq!(surprised, None, "at {speed} m/s");
            attitude.pitch_rad()
        })
    }

    /// A record that begins as the rover starts: what the accelerometer feels then is no slope.
    #[test]
    fn a_start_is_no_slope() {
        let [first, .., last] = pitches([0.05, 0.05, 0.05]);
        assert!(first > 0.01, "felt as a slope at first: {first}");
        assert!(last.abs() < 0.001, "and for long: {last}");
    }

    #[test]
    fn what_speeds_up_on_the_way_does_not_tilt() {
        let [.., before, during, after] = pitches([0.02, 0.02, 0.02, 0.05, 0.05]);
        assert!([before, during, after].iter().all(|pitch| pitch.abs() < 0.001), "{before} {during} {after}");
    }

    /// Minus a tenth of a radian a second for one frame: the pitch goes on, and no frame after it is doubted.
    #[test]
    fn a_glitch_of_the_gyro_tilts_nothing() {
        let noise = Rover::<f64>::assumed().noise;
        let mut attitude = Attitude::new(9.81);
        let accel = Axes { x: Some(0.0), y: Some(0.0), z: Some(9.81) };
        for frame in 0..100 {
            let rate = if frame == 50 { -0.1 } else { 0.0 };
            let gyro = Axes { x: Some(0.0), y: Some(rate), z: Some(0.0) };
            let surprised = attitude.tick(accel, gyro, Some(0.02), 0.1, &noise);
            assert_eq!(surprised, (frame == 50).then_some(Contradicted::Gyro), "frame {frame}");
            assert!(attitude.pitch_rad().abs() < 1.0e-3, "frame {frame}: {}", attitude.pitch_rad());
        }
    }

    /// A rover whose accelerometer falls silent on the level and that climbs a slope then: gravity is where the gyro carries it, and not known as
    /// well as it is felt. Of one axis across its sides nothing is asked for that.
    #[test]
    fn gravity_goes_on_with_the_gyro() {
        let noise = Rover::<f64>::assumed().noise;
        let mut attitude = Attitude::new(9.81);
        let level = Axes { x: Some(0.0), y: None, z: Some(9.81) };
        let gyro = |rate: f64| Axes { x: Some(0.0), y: Some(-rate), z: Some(0.0) };
        (0..50).for_each(|_| _ = attitude.tick(level, gyro(0.0), Some(0.02), 0.1, &noise));
        let felt = attitude.force_variance(noise.accel_m_s2);
        assert!((felt - noise.accel_m_s2 * noise.accel_m_s2).abs() < 1.0e-12, "{felt}");
        (0..20).for_each(|_| _ = attitude.tick(Axes::default(), gyro(0.1), Some(0.02), 0.1, &noise));
        let Axes { x, z, .. } = *attitude.specific_force_m_s2();
        assert!((x - 9.81 * 0.2_f64.sin()).abs() < 0.02 && (z - 9.81 * 0.2_f64.cos()).abs() < 0.02, "{x} {z}");
        assert!(attitude.force_variance(noise.accel_m_s2) > felt);
        assert!(attitude.unfelt_variance() > 0.0 && attitude.felt_rad().0.is_none(), "still known by the gyro");
    }

    /// Without an accelerometer from the start all is told against the gyro, and nothing of gravity is believed.
    #[test]
    fn a_pitch_that_was_never_felt_is_lost() {
        let noise = Rover::<f64>::assumed().noise;
        let mut attitude = Attitude::new(9.81);
        let gyro = Axes { x: Some(0.0), y: Some(-0.1), z: Some(0.0) };
        (0..10).for_each(|_| _ = attitude.tick(Axes::default(), gyro, Some(0.02), 0.1, &noise));
        assert!((attitude.felt_rad().0.expect("the gyro's") - 0.1).abs() < 1.0e-9);
        assert!(attitude.unfelt_variance() > 0.03 && attitude.force_variance(noise.accel_m_s2) > 1.0e5);
    }
}
