//! How filter 1 goes on from frame to frame: as a drive with its inertia, as a torque that swings, or as a drive that holds its rate.

use super::{STATES, SlipTorqueFilter, WheelReadings};
use crate::estimator::scalar_filter::ScalarFilter;
use crate::estimator::trend::{beside_trend, restlessness};
use crate::scalar::Scalar;

/// Nominal drift over a metre of travel: 0.3 N·m and a tenth of slip over a wheel radius.
pub(in crate::estimator) const TORQUE_DRIFT_NM: f64 = 1.1;
const SLIP_DRIFT: f64 = 0.37;
/// How much of the ground's roughness the slip feels: rough ground drives it steadily one way for long, which a single
/// measurement of speed hardly shows.
const SLIP_FROM_ROUGHNESS: f64 = 0.1;
/// Drift of a slip goes with that of its torque, over load and radius: from 0.6 to 2 times as much, the more the farther the wheel
/// slips, with a correlation of 0.8 to 0.9 on every kind of ground. Strong soils grip a wheel that hardly slips better still. So much where
/// nothing slips, how much more over a whole slip up to as much as the torque, and what is left to the slip by itself, as a standard
/// deviation.
const SLIP_WITH_TORQUE: f64 = 0.4;
const MORE_WITH_SLIP: f64 = 2.5;
const SLIP_BY_ITSELF: f64 = 0.6;
/// What the torque of a drive may be off by when its sensor is silent, N·m.
const UNSEEN_TORQUE_NM: f64 = 2.0;
/// A change of rate, squared, up to this many variances of its measurement is taken for noise. Where the drive alone tells of a torque that
/// changes, the slip changes by about this part of what would go with it, one way or the other.
const RATE_NOISE: f64 = 16.0;
const SWINGS_SLIP: f64 = 0.3;
/// What of the drift is left beside what goes on by its trend, as a variance, on restless ground.
const BESIDE_TREND: f64 = 0.72;
/// And beside what goes with the wheel's gain of speed.
const BESIDE_GAIN: f64 = 0.85;
/// These parts of how fast torque and slip wander count as restless. A torque's rate is learned over a short way, and a slip's from a
/// velocimeter whose noise is the size of what it is to tell: on plane ground, too, they seem to drift by some hundredths of
/// the nominal rate.
const TORQUE_AT_REST: f64 = 0.4;
const SLIP_AT_REST: f64 = 0.15;

impl<S: Scalar> SlipTorqueFilter<S> {
    /// Carries the state on: J ω̇ = τ − T, and torque and slip drift beside their trends.
    pub(super) fn predict(&mut self, step_s: S, travel_m: S, readings: &WheelReadings<S>) {
        self.model.motor_torque_nm = readings.motor_torque_nm;
        let slip_factor = self.slip_factor(readings);
        let torque_factor = self.torque_rate.factor();
        let restless = [
            restlessness(S::constant(TORQUE_AT_REST) * torque_factor),
            restlessness(S::constant(SLIP_AT_REST) * slip_factor),
        ];
        self.trends.expect(restless);
        let [torque_trend, slip_trend] = self.trends.per_m();
        let [rate, torque, slip] = *self.filter.estimate().mean();
        let with_torque = S::constant(SLIP_WITH_TORQUE) + S::constant(MORE_WITH_SLIP) * slip.max(S::zero());
        let with_torque = with_torque.min(S::one()) * self.slip_per_torque;
        // A wheel that drives backward slips more as its torque falls. While the drive does not say its torque, nothing tells how the
        // two go together, and the torque's return would throw the slip off.
        let (shared, by_itself) = match readings.motor_torque_nm {
            Some(_) if rate < S::zero() => (-with_torque, S::constant(SLIP_BY_ITSELF)),
            Some(_) => (with_torque, S::constant(SLIP_BY_ITSELF)),
            None => (S::zero(), S::one()),
        };
        let torque_std = match readings.motor_torque_nm {
            Some(_) => readings.motor_torque_std_nm,
            None => S::constant(UNSEEN_TORQUE_NM) * self.scale.torque,
        };
        let [of_torque, of_slip] = self.nominal_variances(travel_m);
        let drift = |nominal: S, factor: S, restless: S| {
            S::constant(BESIDE_GAIN) * nominal * factor * beside_trend(BESIDE_TREND, restless)
        };
        let [restless_torque, restless_slip] = restless;
        self.drift_variances =
            [drift(of_torque, torque_factor, restless_torque), drift(of_slip, slip_factor, restless_slip)];
        let [torque_drift, slip_drift] = self.drift_variances.map(S::sqrt);
        let per_torque = step_s * self.model.inverse_inertia;
        let noise = [per_torque * torque_std, torque_drift, by_itself * slip_drift];
        let [acceleration, ..] = self.model.rates(self.filter.estimate().mean());
        let mean = [rate + step_s * acceleration, torque + travel_m * torque_trend, slip + travel_m * slip_trend];
        let slowed = readings.motor_torque_nm.map_or(S::zero(), |_| per_torque);
        // Rate and torque go on linearly: the root's columns themselves are carried on, as their sigma points would be.
        let to = |[rate, torque, slip]: &[S; STATES]| [*rate - slowed * *torque, *torque, *slip - shared * *torque];
        let back = |[rate, torque, slip]: &[S; STATES]| [*rate, *torque, *slip + shared * *torque];
        let _ = self.filter.random_walk_in(to, back, mean, &noise);
    }

    /// The same where the torque swings: then it is what the drive gives now, but for what the drive's inertia takes where the rate changes
    /// by more than noise, as a square; what it was a frame ago tells nothing.
    pub(super) fn swing_over(
        &mut self,
        step_s: S,
        travel_m: S,
        motor_torque_nm: S,
        turned: S,
        readings: &WheelReadings<S>,
    ) {
        let square = |value: S| value * value;
        let [_, torque_before, _] = *self.filter.estimate().mean();
        let per_torque = step_s * self.model.inverse_inertia;
        let unseen = square(S::constant(UNSEEN_TORQUE_NM) * self.scale.torque);
        let noise = readings.motor_torque_std_nm;
        let variance = square(noise) + (turned / square(per_torque)).min(unseen);
        let rate_std = per_torque * noise + turned.sqrt();
        let changes_nm = motor_torque_nm - torque_before;
        self.go_on_from(&ScalarFilter { mean: motor_torque_nm, variance }, changes_nm, rate_std, travel_m, readings);
    }

    /// The same where the encoder is silent, by which else a torque makes itself felt: then that of the drive, which holds its rate, is a
    /// measurement of it.
    pub(super) fn hold_rate(&mut self, step_s: S, travel_m: S, motor_torque_nm: S, readings: &WheelReadings<S>) {
        let [_, mean, _] = *self.filter.estimate().mean();
        let [_, variance, _] = self.filter.estimate().variances();
        let [of_torque, _] = self.nominal_variances(travel_m);
        let mut torque = ScalarFilter { mean, variance: variance + of_torque * self.torque_rate.factor() };
        let noise = readings.motor_torque_std_nm;
        let spins_up = if readings.settled { S::zero() } else { S::constant(UNSEEN_TORQUE_NM) * self.scale.torque };
        let _ = torque.update(motor_torque_nm, noise * noise + spins_up * spins_up);
        let rate_std = step_s * self.model.inverse_inertia * noise;
        self.go_on_from(&torque, torque.mean - mean, rate_std, travel_m, readings);
    }

    /// With a torque that is known from the drive alone, N·m, and has changed by so much; the rate goes on as it is, give or take one such
    /// standard deviation, rad/s.
    fn go_on_from(
        &mut self,
        torque: &ScalarFilter<S>,
        changes_nm: S,
        rate_std_rad_s: S,
        travel_m: S,
        readings: &WheelReadings<S>,
    ) {
        self.trends.forget();
        self.trends.expect([S::zero(); 2]);
        let [_, of_slip] = self.nominal_variances(travel_m);
        let slipped = S::constant(SWINGS_SLIP) * self.slip_per_torque * changes_nm;
        let slip_std = (of_slip * self.slip_factor(readings) + slipped * slipped).sqrt();
        let _ = self.filter.random_walk(&[rate_std_rad_s, S::zero(), slip_std]);
        let _ = self.filter.forget(1, torque.mean, torque.variance.sqrt());
    }

    /// By how much the rate has changed since the frame before, beyond noise, as its square, rad²/s².
    pub(super) fn turned(&self, readings: &WheelReadings<S>) -> S {
        let [rate, ..] = *self.filter.estimate().mean();
        let square = |value: S| value * value;
        let turned = readings.speeds.rate_rad_s.map_or(S::zero(), |measured| square(measured - rate));
        (turned - S::constant(RATE_NOISE) * square(readings.rate_std_rad_s)).max(S::zero())
    }

    /// How fast the slip wanders, over the nominal drift, as a variance.
    fn slip_factor(&self, readings: &WheelReadings<S>) -> S {
        self.slip_rate.factor() + S::constant(SLIP_FROM_ROUGHNESS) * readings.roughness
    }

    /// Variances of what torque and slip nominally drift by over so much travel.
    pub(super) fn nominal_variances(&self, travel_m: S) -> [S; 2] {
        let [_, of_torque] = self.scale.travels_m(travel_m);
        let square = |drift: f64| S::constant(drift * drift);
        [square(TORQUE_DRIFT_NM) * of_torque, square(SLIP_DRIFT) * travel_m]
    }
}
