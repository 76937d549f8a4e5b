//! Filter 1: slip and resistive torque of one wheel.
//!
//! State: absolute rate ω, resistive torque T, slip s. J ω̇ = τ − T; T and s drift with travel. Measured are the encoder,
//! with the rate of its link added, and the speed of the hub along its contact.
//!
//! A wheel that slips more meets more torque: shear stress grows with shear displacement, and a torque that drifts takes the slip
//! with it. So the drive's torque tells of slip what the camera sees but through its noise.

mod gain_of_speed;
mod process;
#[cfg(test)]
mod tests;
mod torque_glitch;

use super::activity::BLOCKED;
use super::camera_error::CameraError;
use super::drive_inertia::DriveInertia;
use super::rim_growth::RimGrowth;
use super::scale::Scale;
use super::slip_by_speeds::SpeedReadings;
use super::swing::Swing;
use super::trend::Trends;
use super::troubles::Troubles;
use super::walk_rate::{Noise, WalkRate};
use super::watch::{Contradiction, Watch};
use crate::filter::{Fate, Gaussian, Innovation, SigmaPointFilter};
use crate::rover::Rover;
use crate::scalar::Scalar;

use torque_glitch::TorqueGlitch;

pub(super) use process::TORQUE_DRIFT_NM;
pub(super) use torque_glitch::DriveReadings;

pub use super::slip_torque_model::{MEASUREMENTS, STATES, SlipTorqueModel};

/// What is measured of a wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct WheelReadings<S> {
    /// How fast rim and hub move.
    pub speeds: SpeedReadings<S>,
    /// One standard deviation of the rate, rad/s.
    pub rate_std_rad_s: S,
    /// The part of the hub speed's standard deviation that all wheels share: the velocimeter is one camera, m/s.
    pub shared_speed_std_m_s: S,
    /// How rough the ground is: how fast the links' pitches wander, over the nominal drift, as a variance.
    pub roughness: S,
    /// Whether the torque of a wheel of this side swung in the frame before: grousers are on all of them.
    pub side_swings: bool,
    /// Whether the wheel rolls as it will: it neither starts nor stops.
    pub settled: bool,
    /// Whether its encoder says the same as in the frame before.
    pub rate_repeats: bool,
    /// How fast its link turns nose-up, rad/s.
    pub link_rate_rad_s: S,
    /// The share of its speed that the rover gained in the frame before, as its wheels tell it.
    pub rover_gained: S,
    /// Torque of the drive, N·m.
    pub motor_torque_nm: Option<S>,
    /// One standard deviation of that, N·m.
    pub motor_torque_std_nm: S,
}

/// One standard deviation of what is not known at all. All torques here are of set K0, and go with the [scale](Scale) of a rover.
const UNKNOWN: [f64; STATES] = [1.0, 3.0, 0.3];
/// What the torque did is remembered over the length of a contact, three centimetres at two a second: its sensor tells it well, and where
/// a rock was passed it is calm at once.
const TORQUE_FORGOTTEN: f64 = 0.7;
/// How much of the torque a wheel forgets in each frame in which it stands or has just started, N·m: what breaks loose
/// within one frame. And of its slip in a second, as a random walk.
const UNSETTLED_TORQUE_NM: f64 = 1.0;
const UNSETTLED_SLIP: f64 = 0.2;
/// What is added to what is not known of a state that has moved, as standard deviations: where the rims change speed, torque
/// and slip follow within a second.
const LOOSENED: [f64; STATES] = [0.0, 0.5, 0.1];
/// The share of an update's way that counts as the trend's, over the gain of the filter.
const LEARNED: f64 = 0.25;
/// A torque hardly tells a rate that its noise makes uncertain by so many times what the encoder does.
const HARDLY_TOLD: f64 = 8.0;
/// A drive holds its rate to this share in a second, as one standard deviation.
const HELD: f64 = 0.03;
/// A torque that is known so many times better than the drive says it, as a variance, has nothing from that any more.
const KNOWN_WITHOUT: f64 = 2.5;
/// One standard deviation of a wheel's rate about that of the others, over that; and of one that stands, rad/s.
const UNLIKE_OTHERS: f64 = 0.4;
const SUPPOSED_AT_REST: f64 = 0.01;
/// The slip that a wheel starts with, and its standard deviation.
const STARTING_SLIP: [f64; 2] = [0.2, 0.4];

/// The filter of one wheel.
#[derive(Debug, Clone)]
pub(super) struct SlipTorqueFilter<S> {
    filter: SigmaPointFilter<S, STATES>,
    model: SlipTorqueModel<S>,
    /// Slip that goes with a torque where the wheel rolls forward, 1/(N·m).
    slip_per_torque: S,
    /// Torque that goes with a slip where nothing slips, N·m.
    torque_per_slip_nm: S,
    scale: Scale<S>,
    swing: Swing<S>,
    glitch: TorqueGlitch<S>,
    inertia: DriveInertia<S>,
    torque_rate: WalkRate<S>,
    slip_rate: WalkRate<S>,
    camera_error: CameraError<S>,
    rim_growth: RimGrowth<S>,
    /// How fast the link turned in the frame before, rad/s.
    link_rate_rad_s: S,
    watch: Watch<MEASUREMENTS>,
    /// Of torque and slip.
    trends: Trends<S, 2>,
    /// Variances of what these drift by in a step.
    drift_variances: [S; 2],
}

impl<S: Scalar> SlipTorqueFilter<S> {
    /// A filter that knows nothing.
    pub fn new(rover: &Rover<S>, phase: usize) -> Self {
        let scale = Scale::of(rover);
        let unknown = of_rover(&UNKNOWN, &scale);
        let held_nm = rover.mass_kg * rover.gravity_m_s2 * rover.wheel.radius_m / S::constant(6.0);
        let model = SlipTorqueModel {
            radius_m: rover.wheel.radius_m,
            inverse_inertia: S::one() / rover.drive.reflected_inertia_kg_m2,
            motor_torque_nm: None,
        };
        Self {
            filter: SigmaPointFilter::unknowing([S::zero(); STATES], unknown),
            model,
            slip_per_torque: S::one() / held_nm,
            torque_per_slip_nm: gain_of_speed::torque_per_slip_nm(held_nm, &scale),
            scale,
            swing: Swing::new(),
            glitch: TorqueGlitch::new(),
            inertia: DriveInertia::steady(),
            torque_rate: WalkRate::new(phase).forgetting(TORQUE_FORGOTTEN),
            slip_rate: WalkRate::new(phase + 2),
            camera_error: CameraError::none(),
            rim_growth: RimGrowth::none(),
            link_rate_rad_s: S::zero(),
            watch: Watch::new(),
            trends: Trends::new(),
            drift_variances: [S::zero(); 2],
        }
    }

    /// What is known of the state.
    pub fn estimate(&self) -> &Gaussian<S, STATES> {
        self.filter.estimate()
    }

    /// The rate before a frame whose encoder says `measured`, rad/s: where nothing is known of it yet, or it has just begun to turn, that.
    pub fn rate_before(&self, measured: Option<S>, begins: bool) -> S {
        let ([rate, ..], [variance, ..]) = (*self.filter.estimate().mean(), self.filter.estimate().variances());
        let [unknown, ..] = UNKNOWN;
        if begins || variance > S::constant(0.25 * unknown * unknown) { measured.unwrap_or(rate) } else { rate }
    }

    /// The wheel stands or starts, and its encoder is silent: its rate is about that of the other wheels of its side, rad/s.
    pub fn suppose_rate(&mut self, others_rad_s: S) {
        let std = S::constant(UNLIKE_OTHERS) * others_rad_s.abs() + S::constant(SUPPOSED_AT_REST);
        let _ = self.filter.forget(0, others_rad_s, std);
    }

    /// Variance of the part of the slip's error that comes from the camera, and so is common to all wheels.
    pub fn shared_slip_variance(&self) -> S {
        self.camera_error.variance()
    }

    /// Whether its torque swings faster than ground makes torques drift.
    pub fn swings(&self) -> bool {
        self.swing.swings()
    }

    /// What the link has to hold of a torque that the drive gives, N·m, of one such standard deviation: all but what speeds the drive up.
    pub fn held_by_link_nm(&self, motor_torque_nm: S, std_nm: S) -> S {
        motor_torque_nm - self.inertia.takes_nm(std_nm)
    }

    /// How often the filter was in trouble.
    pub fn troubles(&self) -> Troubles {
        Troubles { resets: self.filter.resets(), relearned: self.watch.relearned() }
    }

    /// The wheel stands, or has just started: torque and slip are not what they were a frame ago.
    pub fn unsettle(&mut self, step_s: S) {
        self.swing = Swing::new();
        self.inertia.unsettle();
        let torque_nm = S::constant(UNSETTLED_TORQUE_NM) * self.scale.torque;
        self.loosen(&[S::zero(), torque_nm, S::constant(UNSETTLED_SLIP) * step_s.sqrt()]);
    }

    fn loosen(&mut self, stds: &[S; STATES]) {
        self.trends.forget();
        let _ = self.filter.random_walk(stds);
    }

    /// The wheel rolls as it will: what it was like before is of no account for how fast it wanders.
    pub fn settle(&mut self) {
        self.trends.forget();
        self.torque_rate.restart();
        self.slip_rate.restart();
    }

    /// The wheel starts, stops or turns back: its slip is what the speeds of rim and hub say, if they do.
    pub fn start(&mut self, told: &SpeedReadings<S>) {
        let (mean, std) = told.slip(self.model.radius_m).unwrap_or_else(|| STARTING_SLIP.map(S::constant).into());
        self.restart_slip(mean, std);
    }

    /// The wheel is dragged and does not turn.
    pub fn block(&mut self) {
        self.restart_slip(-S::one(), S::constant(BLOCKED));
    }

    fn restart_slip(&mut self, mean: S, std: S) {
        let _ = self.filter.forget(2, mean, std);
        self.trends.forget();
        self.camera_error = CameraError::none();
    }

    /// Carries the state a step further, over so much travel, and takes what was measured.
    pub fn tick(&mut self, step_s: S, travel_m: S, readings: &WheelReadings<S>) -> Innovation<S, MEASUREMENTS> {
        // The drive, and with it its inertia, turns the wheel against its link.
        self.filter.shift(0, self.link_rate_rad_s - readings.link_rate_rad_s);
        self.link_rate_rad_s = readings.link_rate_rad_s;
        self.follow_gain(readings);
        self.learn_rates(step_s, travel_m, readings);
        let said_nm = readings.motor_torque_nm.or(self.glitch.may_swing_nm());
        self.swing.take(said_nm, readings.motor_torque_std_nm * self.scale.torque);
        let swings = readings.side_swings || self.swings();
        let says_most = swings || readings.speeds.rate_rad_s.is_none();
        let by_drive = readings.motor_torque_nm.filter(|_| says_most);
        let turned = self.turned(readings);
        let tells_rate = self.tells_rate(step_s, readings);
        match by_drive {
            Some(torque) if swings => self.swing_over(step_s, travel_m, torque, turned, readings),
            Some(torque) => self.hold_rate(step_s, travel_m, torque, readings),
            None => self.predict(step_s, travel_m, readings),
        }
        let [_, torque, slip] = *self.filter.estimate().mean();
        if by_drive.is_none() && tells_rate {
            self.take_drive(step_s, turned, readings);
        }
        let told = self.update(tells_rate, readings);
        self.camera_error.follow(self.filter.estimate(), self.model.radius_m, readings);
        self.follow_inertia(readings);
        if by_drive.is_none() {
            self.follow_trends(travel_m, [torque, slip], readings);
        }
        match self.watch.judge(&told) {
            Contradiction::Passing => {}
            Contradiction::Moved => self.jump(&told, readings),
            Contradiction::Wrong => self.loosen(&of_rover(&UNKNOWN, &self.scale)),
        }
        let [of_rate, _] = &told.residuals;
        let rolls = readings.settled && of_rate.fate != Fate::Rejected && tells_rate;
        let rate = readings.speeds.rate_rad_s.filter(|_| rolls);
        self.rim_growth.follow(step_s, rate, readings.rate_std_rad_s, readings.rate_repeats);
        told
    }

    /// Takes the drive's torque for a measurement of the soil's, as it is where the rate is held, so far as that is known worse. What is known
    /// about as well or better is known from the same readings, by what they did to the rate, and they would count twice.
    fn take_drive(&mut self, step_s: S, turned: S, readings: &WheelReadings<S>) {
        let Some(motor) = readings.motor_torque_nm.filter(|_| readings.settled) else { return };
        let [_, variance, _] = self.filter.estimate().variances();
        let [rate, ..] = *self.filter.estimate().mean();
        let square = |value: S| value * value;
        let grows = square(S::constant(HELD) * rate) + square(self.rim_growth.growth_rad_s2());
        let speeds_up = (grows + turned / square(step_s)) / square(self.model.inverse_inertia);
        let noise = square(readings.motor_torque_std_nm) + speeds_up;
        let known = noise / variance;
        if known < S::constant(KNOWN_WITHOUT) {
            let twice = S::constant(2.0) + square(square(known + known));
            self.filter.take(&[S::zero(), S::one(), S::zero()], motor, noise * twice);
        }
    }

    /// Takes in what was measured. Where the torque hardly tells the rate a step on, as in a drive of little inertia, the encoder comes first:
    /// the speed of the hub goes with rate and slip multiplied, and over all the rates that there might be it would tell little of the slip.
    fn update(&mut self, at_once: bool, readings: &WheelReadings<S>) -> Innovation<S, MEASUREMENTS> {
        let SpeedReadings { rate_rad_s, hub_speed_m_s, .. } = readings.speeds;
        let mut told = self.take(&[rate_rad_s, hub_speed_m_s.filter(|_| at_once)], readings);
        if !at_once {
            told = told.followed_by(self.take(&[None, hub_speed_m_s], readings));
        }
        told
    }

    /// Whether the torque tells the rate a step on.
    fn tells_rate(&self, step_s: S, readings: &WheelReadings<S>) -> bool {
        let by_torque = step_s * readings.motor_torque_std_nm * self.model.inverse_inertia;
        by_torque <= S::constant(HARDLY_TOLD) * readings.rate_std_rad_s
    }

    fn take(
        &mut self,
        measured: &[Option<S>; MEASUREMENTS],
        readings: &WheelReadings<S>,
    ) -> Innovation<S, MEASUREMENTS> {
        let model = self.model;
        let noise = [readings.rate_std_rad_s, readings.speeds.hub_speed_std_m_s];
        self.filter.update(|state| model.measure(state), measured, &noise, self.watch.gate())
    }

    fn follow_trends(&mut self, travel_m: S, before: [S; 2], readings: &WheelReadings<S>) {
        let [_, torque, slip] = *self.filter.estimate().mean();
        let [_, torque_variance, slip_variance] = self.filter.estimate().variances();
        let [of_torque, of_slip] = self.drift_variances.map(|variance| S::constant(LEARNED) * variance);
        let [torque_before, slip_before] = before;
        let moved =
            [(torque - torque_before, of_torque / torque_variance), (slip - slip_before, of_slip / slip_variance)];
        self.trends.follow(
            travel_m,
            &moved,
            [readings.speeds.rate_rad_s.is_some(), readings.speeds.hub_speed_m_s.is_some()],
        );
    }

    /// Learns how fast torque and slip wander, from the drive's torque and the quotient of the speeds: 1 − v/(r ω), which below slip 0 is
    /// steeper than the slip of the state and wanders more. With that in its place estimates are the same, and it takes more of the tick.
    fn learn_rates(&mut self, step_s: S, travel_m: S, readings: &WheelReadings<S>) {
        let [of_torque, of_slip] = self.nominal_variances(travel_m);
        let noise = Noise::white(readings.motor_torque_std_nm);
        self.torque_rate.take(readings.motor_torque_nm, noise, of_torque, step_s);
        let [rate, _, _] = *self.filter.estimate().mean();
        let rim = self.model.radius_m * rate;
        if rim.abs() > S::constant(2.0e-3) || readings.speeds.hub_speed_m_s.is_none() {
            let slip = readings.speeds.hub_speed_m_s.map(|hub| S::one() - hub / rim);
            self.slip_rate.take(slip, Noise::white(readings.speeds.hub_speed_std_m_s / rim), of_slip, step_s);
        }
    }

    /// The state has moved: where the encoder is contradicted, by as much as the drive is from the torque; where the speed of the hub is, the
    /// slip is what the speeds say. By less, what is believed would go on to be contradicted while they move away.
    fn jump(&mut self, told: &Innovation<S, MEASUREMENTS>, readings: &WheelReadings<S>) {
        let [_, torque, _] = *self.filter.estimate().mean();
        let [of_rate, of_hub] = told.residuals.each_ref().map(|residual| residual.fate == Fate::Rejected);
        let [_, mut torque_off, slip_off] = of_rover(&LOOSENED, &self.scale);
        let [_, unknown_torque, _] = of_rover(&UNKNOWN, &self.scale);
        if let Some(motor) = readings.motor_torque_nm.filter(|_| of_rate) {
            torque_off = (motor - torque).abs().max(torque_off).min(unknown_torque);
        }
        // What was predicted meanwhile with a torque that is off has taken the rate along.
        if let Some(rate) = readings.speeds.rate_rad_s.filter(|_| of_rate) {
            let _ = self.filter.forget(0, rate, readings.rate_std_rad_s);
        }
        self.loosen(&[S::zero(), torque_off, slip_off]);
        if let Some((slip, std)) = readings.speeds.slip(self.model.radius_m).filter(|_| of_hub) {
            self.restart_slip(slip, std);
        }
    }

    /// Without the encoder nothing tells how the wheel speeds up.
    fn follow_inertia(&mut self, readings: &WheelReadings<S>) {
        let [_, torque, _] = *self.filter.estimate().mean();
        let larger = match (readings.motor_torque_nm, readings.speeds.rate_rad_s) {
            (Some(motor), Some(_)) => motor - torque,
            _ => S::zero(),
        };
        self.inertia.follow(larger, readings.motor_torque_std_nm);
    }
}

/// Standard deviations of the states for a rover, given those for K0.
fn of_rover<S: Scalar>(&[rate, torque, slip]: &[f64; STATES], scale: &Scale<S>) -> [S; STATES] {
    [S::constant(rate), S::constant(torque) * scale.torque, S::constant(slip)]
}
