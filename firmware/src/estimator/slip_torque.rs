//! Filter 1: slip and resistive torque of one wheel.
//!
//! State: absolute rate ω, resistive torque T, slip s. J ω̇ = τ − T; T and s drift with travel. Measured are the encoder,
//! with the rate of its link added, and the speed of the hub along its contact.
//!
//! A wheel that slips more meets more torque: shear stress grows with shear displacement, and a torque that drifts takes the slip
//! with it. So the drive's torque tells of slip what the camera sees but through its noise.

use super::activity::BLOCKED;
use super::drive_inertia::DriveInertia;
use super::scale::Scale;
use super::slip_by_speeds::SpeedReadings;
use super::slip_torque_model::travel_over_rim;
use super::swing::Swing;
use super::trend::{Trends, beside_trend, restlessness};
use super::walk_rate::{Noise, WalkRate};
use super::watch::{Contradiction, Watch};
use crate::filter::{Fate, Gaussian, Innovation, Prediction, SigmaPointFilter};
use crate::rover::Rover;
use crate::scalar::Scalar;

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
    /// Torque of the drive, N·m.
    pub motor_torque_nm: Option<S>,
    /// One standard deviation of that, N·m.
    pub motor_torque_std_nm: S,
}

/// One standard deviation of what is not known at all. All torques here are of set K0, and go with the [scale](Scale) of a rover.
const UNKNOWN: [f64; STATES] = [1.0, 3.0, 0.3];
/// Nominal drift over a metre of travel: 0.3 N·m and a tenth of slip over a wheel radius.
pub(super) const TORQUE_DRIFT_NM: f64 = 1.1;
const SLIP_DRIFT: f64 = 0.37;
/// What the torque did is remembered over the length of a contact, three centimetres at two a second: its sensor tells it well, and where
/// a rock was passed it is calm at once.
const TORQUE_FORGOTTEN: f64 = 0.7;
/// How much of the ground's roughness the slip feels: rough ground drives it steadily one way for long, which a single
/// measurement of speed hardly shows.
const SLIP_FROM_ROUGHNESS: f64 = 0.1;
/// Drift of a slip goes with that of its torque, over load and radius: from 0.6 to 2 times as much, the more the farther the wheel
/// slips, with a correlation of 0.8 to 0.9 on every kind of ground. What is left to the slip by itself, as a standard deviation.
const SLIP_BY_ITSELF: f64 = 0.6;
/// What the torque of a drive may be off by when its sensor is silent, N·m.
const UNSEEN_TORQUE_NM: f64 = 2.0;
/// How much of the torque a wheel forgets in each frame in which it stands or has just started, N·m: what breaks loose
/// within one frame. And of its slip in a second, as a random walk.
const UNSETTLED_TORQUE_NM: f64 = 1.0;
const UNSETTLED_SLIP: f64 = 0.2;
/// Where a torque swings: a change of rate, squared, up to this many variances of its measurement is taken for noise, and the slip changes by
/// about this part of what would go with the torque, one way or the other.
const RATE_NOISE: f64 = 16.0;
const SWINGS_SLIP: f64 = 0.3;
/// What is added to what is not known of a state that has moved, as standard deviations: where the rims change speed, torque
/// and slip follow within a second.
const LOOSENED: [f64; STATES] = [0.0, 0.5, 0.1];
/// What of the drift is left beside what goes on by its trend, as a variance, on restless ground.
const BESIDE_TREND: f64 = 0.6;
/// The share of an update's way that counts as the trend's, over the gain of the filter.
const LEARNED: f64 = 0.25;
/// These parts of how fast torque and slip wander count as restless. A torque's rate is learned over a short way, and a slip's from a
/// velocimeter whose noise is the size of what it is to tell: on plane ground, too, they seem to drift by some hundredths of
/// the nominal rate.
const TORQUE_AT_REST: f64 = 0.4;
const SLIP_AT_REST: f64 = 0.15;
/// The slip that a wheel starts with, and its standard deviation.
const STARTING_SLIP: [f64; 2] = [0.2, 0.4];

/// The filter of one wheel.
#[derive(Debug, Clone)]
pub(super) struct SlipTorqueFilter<S> {
    filter: SigmaPointFilter<S, STATES>,
    model: SlipTorqueModel<S>,
    /// Slip that goes with a torque where the wheel rolls forward, 1/(N·m).
    slip_per_torque: S,
    scale: Scale<S>,
    swing: Swing<S>,
    inertia: DriveInertia<S>,
    torque_rate: WalkRate<S>,
    slip_rate: WalkRate<S>,
    shared_slip_variance: S,
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
        let model = SlipTorqueModel {
            radius_m: rover.wheel.radius_m,
            inverse_inertia: S::one() / rover.drive.reflected_inertia_kg_m2,
            motor_torque_nm: None,
        };
        Self {
            filter: SigmaPointFilter::unknowing([S::zero(); STATES], unknown),
            model,
            slip_per_torque: S::constant(6.0) / (rover.mass_kg * rover.gravity_m_s2 * rover.wheel.radius_m),
            scale,
            swing: Swing::new(),
            inertia: DriveInertia::steady(),
            torque_rate: WalkRate::new(phase).forgetting(TORQUE_FORGOTTEN),
            slip_rate: WalkRate::new(phase + 2),
            shared_slip_variance: S::zero(),
            watch: Watch::new(),
            trends: Trends::new(),
            drift_variances: [S::zero(); 2],
        }
    }

    /// What is known of the state.
    pub fn estimate(&self) -> &Gaussian<S, STATES> {
        self.filter.estimate()
    }

    /// The rate before a frame whose encoder says `measured`, rad/s: where nothing is known of it yet, that.
    pub fn rate_before(&self, measured: Option<S>) -> S {
        let ([rate, ..], [variance, ..]) = (*self.filter.estimate().mean(), self.filter.estimate().variances());
        let [unknown, ..] = UNKNOWN;
        if variance > S::constant(0.25 * unknown * unknown) { measured.unwrap_or(rate) } else { rate }
    }

    /// Variance of the part of the slip's error that comes from the camera, and so is common to all wheels.
    pub fn shared_slip_variance(&self) -> S {
        self.shared_slip_variance
    }

    /// Whether its torque swings faster than ground makes torques drift.
    pub fn swings(&self) -> bool {
        self.swing.swings()
    }

    /// What the link has to hold of a torque that the drive gives, N·m, of one such standard deviation: all but what speeds the drive up.
    pub fn held_by_link_nm(&self, motor_torque_nm: S, std_nm: S) -> S {
        motor_torque_nm - self.inertia.takes_nm(std_nm)
    }

    /// How often the filter fell back to its floor, and how often it gave up what it believed.
    pub fn troubles(&self) -> (u32, u32) {
        (self.filter.resets(), self.watch.relearned())
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

    #[inline(never)] // flash is scarcer than the time of a call
    fn restart_slip(&mut self, mean: S, std: S) {
        let _ = self.filter.forget(2, mean, std);
        self.trends.forget();
        self.shared_slip_variance = S::zero();
    }

    /// Carries the state a step further, over so much travel, and takes what was measured.
    pub fn tick(&mut self, step_s: S, travel_m: S, readings: &WheelReadings<S>) -> Innovation<S, MEASUREMENTS> {
        self.learn_rates(step_s, travel_m, readings);
        self.swing.take(readings.motor_torque_nm, readings.motor_torque_std_nm * self.scale.torque);
        let swinging = readings.motor_torque_nm.filter(|_| readings.side_swings || self.swings());
        match swinging {
            Some(torque) => self.swing_over(step_s, travel_m, torque, readings),
            None => self.predict(step_s, travel_m, readings),
        }
        let [_, torque, slip] = *self.filter.estimate().mean();
        let model = self.model;
        let told = self.filter.update(
            |state| model.measure(state),
            &[readings.speeds.rate_rad_s, readings.speeds.hub_speed_m_s],
            &[readings.rate_std_rad_s, readings.speeds.hub_speed_std_m_s],
            self.watch.gate(),
        );
        self.share_camera_error(readings);
        self.follow_inertia(readings);
        if swinging.is_none() {
            self.follow_trends(travel_m, [torque, slip], readings);
        }
        match self.watch.judge(&told) {
            Contradiction::Passing => {}
            Contradiction::Moved => self.jump(&told, readings),
            Contradiction::Wrong => self.loosen(&of_rover(&UNKNOWN, &self.scale)),
        }
        told
    }

    fn predict(&mut self, step_s: S, travel_m: S, readings: &WheelReadings<S>) {
        self.model.motor_torque_nm = readings.motor_torque_nm;
        let model = self.model;
        let slip_factor = self.slip_factor(readings);
        let torque_factor = self.torque_rate.factor();
        let restless = [
            restlessness(S::constant(TORQUE_AT_REST) * torque_factor),
            restlessness(S::constant(SLIP_AT_REST) * slip_factor),
        ];
        self.trends.expect(restless);
        let [torque_trend, slip_trend] = self.trends.per_m();
        let [rate, ..] = *self.filter.estimate().mean();
        // A wheel that drives backward slips more as its torque falls. While the drive does not say its torque, nothing tells how the
        // two go together, and the torque's return would throw the slip off.
        let (shared, by_itself) = match readings.motor_torque_nm {
            Some(_) if rate < S::zero() => (-self.slip_per_torque, S::constant(SLIP_BY_ITSELF)),
            Some(_) => (self.slip_per_torque, S::constant(SLIP_BY_ITSELF)),
            None => (S::zero(), S::one()),
        };
        let process = |state: &[S; STATES]| {
            let [rate, torque, slip] = *state;
            let [acceleration, ..] = model.rates(state);
            let torque = torque + travel_m * torque_trend;
            [rate + step_s * acceleration, torque, slip + travel_m * slip_trend - shared * torque]
        };
        let torque_std = match readings.motor_torque_nm {
            Some(_) => readings.motor_torque_std_nm,
            None => S::constant(UNSEEN_TORQUE_NM) * self.scale.torque,
        };
        let drift = |nominal: S, factor: S, restless: S| nominal * factor * beside_trend(BESIDE_TREND, restless);
        let [of_torque, of_slip] = self.nominal_variances(travel_m);
        let [restless_torque, restless_slip] = restless;
        self.drift_variances =
            [drift(of_torque, torque_factor, restless_torque), drift(of_slip, slip_factor, restless_slip)];
        let [torque, slip] = self.drift_variances.map(S::sqrt);
        let noise = [step_s * torque_std * self.model.inverse_inertia, torque, by_itself * slip];
        // Where it is not done the mean has stayed, slip and all.
        if self.filter.predict(process, &noise) == Prediction::Done {
            self.filter.shear(1, 2, shared);
        }
    }

    /// The same where the torque swings: then it is what the drive gives now, but for what the drive's inertia takes where the rate changes
    /// by more than noise; what it was a frame ago tells nothing.
    fn swing_over(&mut self, step_s: S, travel_m: S, motor_torque_nm: S, readings: &WheelReadings<S>) {
        self.trends.forget();
        self.trends.expect([S::zero(); 2]);
        let square = |value: S| value * value;
        let [rate, torque_before, _] = *self.filter.estimate().mean();
        let [_, of_slip] = self.nominal_variances(travel_m);
        let slip_factor = self.slip_factor(readings);
        let slipped = S::constant(SWINGS_SLIP) * self.slip_per_torque * (motor_torque_nm - torque_before);
        let turned = readings.speeds.rate_rad_s.map_or(S::zero(), |measured| square(measured - rate));
        let turned = (turned - S::constant(RATE_NOISE) * square(readings.rate_std_rad_s)).max(S::zero());
        let per_torque = step_s * self.model.inverse_inertia;
        let unseen = square(S::constant(UNSEEN_TORQUE_NM) * self.scale.torque);
        let noise = readings.motor_torque_std_nm;
        let torque_variance = square(noise) + (turned / square(per_torque)).min(unseen);
        let rate_std = per_torque * noise + turned.sqrt();
        let slip_std = (of_slip * slip_factor + square(slipped)).sqrt();
        let _ = self.filter.random_walk(&[rate_std, S::zero(), slip_std]);
        let _ = self.filter.forget(1, motor_torque_nm, torque_variance.sqrt());
    }

    /// How fast the slip wanders, over the nominal drift, as a variance.
    fn slip_factor(&self, readings: &WheelReadings<S>) -> S {
        self.slip_rate.factor() + S::constant(SLIP_FROM_ROUGHNESS) * readings.roughness
    }

    /// Variances of what torque and slip nominally drift by over so much travel.
    fn nominal_variances(&self, travel_m: S) -> [S; 2] {
        let [_, of_torque] = self.scale.travels_m(travel_m);
        let square = |drift: f64| S::constant(drift * drift);
        [square(TORQUE_DRIFT_NM) * of_torque, square(SLIP_DRIFT) * travel_m]
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

    /// Learns how fast torque and slip wander, from the drive's torque and the quotient of the speeds.
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

    /// Follows the camera's error through the filter: the gain g of the slip on the hub's speed takes the new error in, and
    /// 1 − g h of the old one stays, h being the slope of the speed in the slip.
    fn share_camera_error(&mut self, readings: &WheelReadings<S>) {
        if readings.speeds.hub_speed_m_s.is_none() {
            return;
        }
        let [rate, _, slip] = *self.filter.estimate().mean();
        let [_, _, slip_variance] = self.filter.estimate().variances();
        let ratio = travel_over_rim(slip);
        let rim = self.model.radius_m * rate;
        let slope = if slip >= S::zero() { rim } else { rim * ratio * ratio };
        let noise = readings.speeds.hub_speed_std_m_s;
        let gain = slope * slip_variance / (noise * noise);
        let kept = S::one() - gain * slope;
        let taken = gain * readings.shared_speed_std_m_s;
        self.shared_slip_variance = (kept * kept * self.shared_slip_variance + taken * taken).min(slip_variance);
    }
}

/// Standard deviations of the states for a rover, given those for K0.
fn of_rover<S: Scalar>(&[rate, torque, slip]: &[f64; STATES], scale: &Scale<S>) -> [S; STATES] {
    [S::constant(rate), S::constant(torque) * scale.torque, S::constant(slip)]
}

#[cfg(test)]
mod tests;
