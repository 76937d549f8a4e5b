//! Filter 2, first half: the contact angles of a side, from how the side moves.
//!
//! State: travel ratio κ, contact angles γ of front, middle and rear wheel, pitch of the rocker, the bogie and the body. The
//! links' pitches change as the hubs roll along their contacts ([`RollingSide`]), the body's as the gyro says; κ and γ drift
//! with travel. Measured are the velocity of the differential axis, the joints' angles, and the body's pitch by the
//! accelerometer. The body's pitch is a state because its error lasts: taken as it is from a filter of its own, it would be
//! the same error in many frames of the rocker's angle, which this filter would take for what the rocker does. So the
//! contact angles come from where the hubs go, never from a quotient of noisy rates.

use super::activity::STANDING_M_S;
use super::attitude::Attitude;
use super::joints::Joints;
use super::load_shift::LoadShift;
use super::roughness::{ANGLE_DRIFT, Motion, RATIO_DRIFT, Roughness, of_front_alone, of_unlike};
use super::runs::Runs;
use super::trend::{Trends, beside_trend, restlessness};
use super::troubles::Troubles;
use super::watch::{Contradiction, Watch};
use crate::filter::{Gate, Gaussian, Innovation, SigmaPointFilter};
use crate::rover::{PerAxle, Planar, RollingMotion, RollingSide, Rover, SensorNoise, hub_speed_slopes};
use crate::scalar::Scalar;

pub use super::contact_angle_model::{ContactAngleModel, MEASUREMENTS, STATES};

/// What is measured of a side.
#[derive(Debug, Clone, Copy)]
pub(super) struct SideReadings<S> {
    /// Velocity of this side's end of the axis in the body's axes, m/s.
    pub axis_velocity_m_s: Planar<Option<S>>,
    /// One standard deviation of each component of that, m/s.
    pub velocity_std_m_s: Planar<S>,
    /// This side's rocker against the body, rad.
    pub rocker_angle_rad: Option<S>,
    /// The bogie against the rocker, rad.
    pub bogie_angle_rad: Option<S>,
    /// How far the innovations of the side's forces come in runs, above chance.
    pub runs_of_forces: S,
    /// Whether one of its wheels stands, or has just started.
    pub starts: bool,
    /// By how much the ground turns under the middle and the rear wheel, as the front wheel met it, rad/m.
    pub turns_per_m: [Option<S>; 2],
}

/// One standard deviation of a ratio that is not known at all, and of contact angles about the pitch of their link, rad:
/// wider, and the filter might take a wheel that rolls forward for one that hangs from a ceiling and rolls back.
const UNKNOWN_RATIO: f64 = 0.3;
const UNKNOWN_ANGLE: f64 = 0.2;
/// One standard deviation by which the terrain under a wheel that stands is steeper than its link, rad: some 0.07 on hills, 0.13 about
/// rocks.
pub(super) const STEEPER_THAN_LINK: f64 = 0.1;
/// The part of that which is added where the state has moved faster than it drifts.
const LOOSENED: f64 = 0.2;
/// A contact angle farther from the pitch of its link is given up, rad; and one whose variance is this many times that of one that
/// is not known at all: over so wide a spread the model bends so much that no measurement would narrow it.
const IMPOSSIBLE_ANGLE: f64 = 1.2;
const LOST: f64 = 1.5;
/// What runs of the forces add to the drift of the front wheel's angle alone, for each unit above what is taken for chance: a wheel that
/// meets a rock is felt by cells and drives some frames before links and velocity have moved; the others follow where it was.
const FRONT_FROM_FORCES: f64 = 0.15;
/// Runs up to these are taken for chance, of the forces and of how the side moves: in white noise one frame in forty has more.
pub(super) const RUN_OF_FORCES: f64 = 2.5;
const RUN: f64 = 3.2;
/// What of the drift is left beside what goes on by its trend, as a variance, on restless ground.
const BESIDE_TREND: f64 = 0.5;
/// The share of an update's way that counts as the trend's, over the gain of the filter.
const LEARNED: f64 = 0.25;
/// Runs are looked for from this measurement on: of the velocity up, the rocker and the bogie. What is forward tells nothing of
/// the angles, and the body's pitch is no ground's doing.
const FIRST_IN_RUNS: usize = 1;
const RUNS: usize = MEASUREMENTS - 1 - FIRST_IN_RUNS;
/// How much the track tells of how the ground turns under a wheel of the bogie, beside its trend; one standard deviation of how far the ground
/// turns otherwise, over that; and what is left of the drift, as a variance.
const OF_TRACK: f64 = 0.7;
const UNLIKE_TRACK: f64 = 0.7;
const BESIDE_TRACK: f64 = 0.6;
/// Drift of a link's pitch beyond what rolling explains, rad over a metre.
const PITCH_DRIFT: f64 = 1.0e-3;

/// The filter of one side.
#[derive(Debug, Clone)]
pub(super) struct ContactAngleFilter<S> {
    filter: SigmaPointFilter<S, STATES>,
    model: ContactAngleModel<S>,
    joints: Joints<S>,
    roughness: Roughness<S>,
    watch: Watch<MEASUREMENTS>,
    load_shift: LoadShift<S>,
    begun: bool,
    runs: Runs<S, RUNS>,
    trends: Trends<S, 3>,
    /// Variances of what the angles of the front wheel and of the bogie's drift by in a step, rad².
    drift_variances: [S; 2],
    /// The same of what the paths of the hubs turn back to the terrain by.
    turned_back: S,
    /// Variances of the angles after the last frame, rad².
    variances: PerAxle<S>,
    /// Of each hub's speed against that of the axis, in the states; over the speed of the side.
    speed_slopes: PerAxle<[S; STATES]>,
}

impl<S: Scalar> ContactAngleFilter<S> {
    /// A filter that knows nothing but that the rover stands more or less level.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn new(rover: &Rover<S>, phase: usize) -> Self {
        let side = RollingSide::new(rover);
        let (zero, one) = (S::zero(), S::one());
        let model = ContactAngleModel {
            side,
            rim_speed_m_s: zero,
            body_pitch: (zero, one),
            body_rate_rad_s: zero,
            sinking_rad: PerAxle::all(zero),
        };
        Self {
            filter: SigmaPointFilter::unknowing([one, zero, zero, zero, zero, zero, zero], Self::unknown_std()),
            model,
            joints: Joints::new(),
            roughness: Roughness::new(phase),
            watch: Watch::new(),
            load_shift: LoadShift::none(),
            begun: false,
            runs: Runs::new(),
            trends: Trends::new(),
            drift_variances: [zero; 2],
            turned_back: zero,
            variances: PerAxle::all(S::constant(UNKNOWN_ANGLE * UNKNOWN_ANGLE)),
            speed_slopes: hub_speed_slopes(rover)
                .map(|PerAxle { front, middle, rear }| [zero, front, middle, rear, zero, zero, zero]),
        }
    }

    fn unknown_std() -> [S; STATES] {
        Self::unknown_but_for(UNKNOWN_ANGLE)
    }

    /// Standard deviations of a state of which no more is known than its angles, each to so many rad.
    fn unknown_but_for(angle_std_rad: f64) -> [S; STATES] {
        let angle = S::constant(angle_std_rad);
        [S::constant(UNKNOWN_RATIO), angle, angle, angle, angle, angle, angle]
    }

    /// Starts from the pitches that the first joint angles tell: the terrain is about as steep as the links.
    fn begin(&mut self, body_pitch_rad: S, [rocker, bogie]: [Option<S>; 2]) {
        let (Some(rocker), Some(bogie)) = (rocker, bogie) else { return };
        let rocker = body_pitch_rad + rocker;
        let bogie = rocker + bogie;
        let mean = [S::one(), rocker, bogie, bogie, rocker, bogie, body_pitch_rad];
        if let Ok(start) = Gaussian::independent(mean, Self::unknown_but_for(STEEPER_THAN_LINK)) {
            self.filter.restart(start);
            self.begun = true;
        }
    }

    /// Gives up contact angles that no wheel on the ground has, and those that are lost.
    fn give_up_impossible(&mut self) {
        let [_, front, middle, rear, rocker, bogie, _] = *self.filter.estimate().mean();
        let PerAxle { front: of_front, middle: of_middle, rear: of_rear } = self.variances;
        let lost = S::constant(LOST * UNKNOWN_ANGLE * UNKNOWN_ANGLE);
        let places = [(1, front, of_front, rocker), (2, middle, of_middle, bogie), (3, rear, of_rear, bogie)];
        for (index, angle, variance, link) in places {
            if (angle - link).abs() > S::constant(IMPOSSIBLE_ANGLE) || variance > lost {
                let _ = self.filter.forget(index, link, S::constant(UNKNOWN_ANGLE));
            }
        }
    }

    /// What is known of the state.
    pub fn estimate(&self) -> &Gaussian<S, STATES> {
        self.filter.estimate()
    }

    /// Sine and cosine of the body's pitch that the last frame was taken with.
    pub fn body_pitch(&self) -> (S, S) {
        self.model.body_pitch
    }

    /// What is known of the joints and of how the axis rises.
    pub fn joints(&self) -> &Joints<S> {
        &self.joints
    }

    /// How load that shifts turns the bogie.
    pub fn load_shift(&self) -> &LoadShift<S> {
        &self.load_shift
    }

    /// The runs of its innovations: of the velocity up, the rocker and the bogie.
    pub fn runs(&self) -> &Runs<S, RUNS> {
        &self.runs
    }

    /// How its contact angles turn along the way.
    pub fn trends(&self) -> &Trends<S, 3> {
        &self.trends
    }

    /// The motion at the mean.
    pub fn motion(&self) -> RollingMotion<S> {
        self.model.motion(self.filter.estimate().mean())
    }

    /// What the errors of the contact angles make of the hubs' speeds against that of the axis, of a side at this speed, as
    /// variances, m²/s².
    pub fn hub_speed_variances(&self, speed_m_s: S) -> PerAxle<S> {
        self.speed_slopes.as_ref().map(|slopes| speed_m_s * speed_m_s * self.filter.estimate().variance_of_sum(slopes))
    }

    /// The contact angles, rad: those of the paths of the hubs.
    pub fn angles(&self) -> PerAxle<S> {
        let [_, front, middle, rear, ..] = *self.filter.estimate().mean();
        PerAxle { front, middle, rear }
    }

    /// The pitch of the link that each wheel is on, rad.
    pub fn links(&self) -> PerAxle<S> {
        let [.., rocker, bogie, _] = *self.filter.estimate().mean();
        PerAxle { front: rocker, middle: bogie, rear: bogie }
    }

    /// The mean of the variances of the contact angles, rad².
    pub fn mean_variance(&self) -> S {
        let PerAxle { front, middle, rear } = self.variances;
        S::constant(1.0 / 3.0) * (front + middle + rear)
    }

    /// By what variance the contact angles of the bogie's wheels drifted in the last step, rad².
    pub fn drift_variance(&self) -> S {
        let [_, drift] = self.drift_variances;
        drift
    }

    /// By how much the paths of the hubs are steeper than their links lie, rad: the mean, and the mean of the squares less what their
    /// errors make of it, rad².
    pub fn departure(&self) -> (S, S) {
        let departures = self.angles().zip(self.links()).map(|(angle, link)| angle - link).into_array();
        let departures = departures.into_iter().zip(self.variances.as_array());
        let third = S::constant(1.0 / 3.0);
        let sums = departures.fold((S::zero(), S::zero()), |(sum, squares), (departure, variance)| {
            (sum + departure, squares + departure * departure - *variance)
        });
        (third * sums.0, third * sums.1)
    }

    /// The wheels dig in, and until the next frame the paths of their hubs turn back to the terrain by an angle of this variance, rad².
    pub fn dig_in(&mut self, variance: S) {
        self.trends.forget();
        self.turned_back = variance.min(S::constant(UNKNOWN_ANGLE * UNKNOWN_ANGLE));
    }

    /// The wheels have dug in: how the links moved meanwhile tells nothing of how rough the terrain is.
    pub fn settle(&mut self) {
        self.roughness.restart();
    }

    /// How often the filter was in trouble.
    pub fn troubles(&self) -> Troubles {
        Troubles { resets: self.filter.resets(), relearned: self.watch.relearned() }
    }

    /// Carries the state a step further, with rims that move at `rim_speed_m_s`, and takes what was measured.
    pub fn tick(
        &mut self,
        step_s: S,
        rim_speed_m_s: S,
        sinking_rad: &PerAxle<S>,
        attitude: &Attitude<S>,
        readings: &SideReadings<S>,
        noise: &SensorNoise<S>,
    ) -> Innovation<S, MEASUREMENTS> {
        let body_pitch_rad = attitude.pitch_rad();
        let (rate, rate_std) = attitude.rate_rad_s();
        self.model.body_rate_rad_s = rate;
        self.model.sinking_rad = *sinking_rad;
        // Where nothing rolls, nothing is learned of the contacts.
        let stands = rim_speed_m_s.abs() < S::constant(STANDING_M_S);
        self.model.rim_speed_m_s = if stands { S::zero() } else { rim_speed_m_s };
        let joints = [readings.rocker_angle_rad, readings.bogie_angle_rad];
        let [rocker, bogie] = self.joints.tick(joints, noise.angle_rad, self.travel_m(step_s), step_s);
        if !self.begun {
            self.begin(body_pitch_rad, [rocker.0, bogie.0]);
        }
        let starts = readings.starts && !stands;
        let turns = starts.then(|| (rate - self.motion().rocker_rate_rad_s, rate_std));
        let shifts_rad = self.load_shift.begin(turns, step_s);
        self.predict(step_s, [rate_std, shifts_rad], readings);
        let (before, bogie_before) = (self.angles(), self.links().middle);
        self.model.body_pitch = body_pitch_rad.sin_cos();
        let ContactAngleModel { rim_speed_m_s: speed_m_s, body_pitch, .. } = self.model;
        if !stands {
            self.roughness.learn(&Motion { speed_m_s, step_s, body_pitch_rad, body_pitch }, readings, noise);
        }
        let (velocity, velocity_std) = (&readings.axis_velocity_m_s, &readings.velocity_std_m_s);
        let rise = self.rise((velocity.z, velocity_std.z), step_s);
        let felt = attitude.felt_rad();
        let noise_std = [velocity_std.x, rise.1, rocker.1, bogie.1, felt.1];
        let measured = [velocity.x, rise.0, rocker.0, bogie.0, felt.0];
        let model = &self.model;
        // Not the watch's gate: what is loosened below is wide enough for what is plausible.
        let told = self.filter.update(|state| model.measure(state), &measured, &noise_std, Gate::one_in_a_thousand());
        self.load_shift.follow(self.links().middle - bogie_before, step_s);
        let is_loosened = self.loosen_contradicted(&told);
        let [_, front, middle, rear, ..] = self.filter.estimate().variances();
        let variances = PerAxle { front, middle, rear };
        if !is_loosened {
            let told = measured.iter().take(MEASUREMENTS - 1).any(Option::is_some);
            self.follow_trends(step_s, &before, &variances, told);
        }
        self.variances = variances;
        self.turned_back = S::zero();
        self.give_up_impossible();
        self.runs.take(&told, FIRST_IN_RUNS);
        told
    }

    /// Where measurements contradict the state, it counts for less or for nothing. Whether they do.
    fn loosen_contradicted(&mut self, told: &Innovation<S, MEASUREMENTS>) -> bool {
        let stds = match self.watch.judge(told) {
            Contradiction::Passing => return false,
            Contradiction::Moved => Self::unknown_std().map(|std| std * S::constant(LOOSENED)),
            Contradiction::Wrong => Self::unknown_std(),
        };
        self.trends.forget();
        let _ = self.filter.random_walk(&stds);
        true
    }

    /// How fast the axis rises, m/s, and its standard deviation.
    fn rise(&mut self, measured: (Option<S>, S), step_s: S) -> (Option<S>, S) {
        let [ratio, .., rocker, bogie, body] = *self.filter.estimate().mean();
        let links_rad = S::constant(0.5) * (rocker + bogie) - body;
        self.joints.rise(measured, step_s, ratio * self.model.rim_speed_m_s, links_rad)
    }

    fn follow_trends(&mut self, step_s: S, before: &PerAxle<S>, variances: &PerAxle<S>, told: bool) {
        // With a steady gain, the drift's variance is to that of the angle as that gain is to one.
        let learned = S::constant(LEARNED) * self.drift_variance();
        let moved = self.angles().zip(*before).zip(*variances);
        let moved = moved.map(|((now, before), variance)| (now - before, learned / variance));
        self.trends.follow(self.travel_m(step_s), &moved.into_array(), [told; 3]);
    }

    /// How rough the ground is: how fast the links' pitches wander, over the nominal drift of a contact angle, as a
    /// variance.
    pub fn roughness(&self) -> S {
        self.roughness.of_links()
    }

    /// How far the hubs go in a step: wheels that spin on the spot meet no other ground.
    fn travel_m(&self, step_s: S) -> S {
        let [ratio, ..] = *self.filter.estimate().mean();
        (ratio * self.model.rim_speed_m_s).abs() * step_s
    }

    fn predict(&mut self, step_s: S, [rate_std_rad_s, shifts_rad]: [S; 2], readings: &SideReadings<S>) {
        let model = &self.model;
        let (travel, rim_travel) = (self.travel_m(step_s), self.model.rim_speed_m_s.abs() * step_s);
        let [.., rocker, bogie, _] = *self.filter.estimate().mean();
        let factor =
            self.roughness.of_angles(bogie - rocker, self.runs.above(RUN)) + of_unlike(&self.angles(), &self.variances);
        let restless = restlessness(factor);
        self.trends.expect([restless; 3]);
        let mut turned = PerAxle::from_array(self.trends.per_m()).map(|trend| travel * trend);
        let (mut unlike, mut beside_track) = ([S::zero(); 2], S::one());
        let bogie = [&mut turned.middle, &mut turned.rear].into_iter().zip(&mut unlike);
        for ((turned, unlike), turns_per_m) in bogie.zip(readings.turns_per_m) {
            let Some(turns_per_m) = turns_per_m else { continue };
            let as_front = travel * turns_per_m;
            *turned += S::constant(OF_TRACK) * (as_front - *turned);
            *unlike = S::constant(UNLIKE_TRACK) * as_front;
            beside_track = S::constant(BESIDE_TRACK);
        }
        let process = |state: &[S; STATES]| {
            let [ratio, front, middle, rear, links_and_body @ ..] = *state;
            let [.., rocker_rate, bogie_rate, body_rate] = model.rates(state);
            let [rocker, bogie, body] = links_and_body;
            [
                ratio,
                front + turned.front,
                middle + turned.middle,
                rear + turned.rear,
                rocker + step_s * rocker_rate,
                bogie + step_s * bogie_rate,
                body + step_s * body_rate,
            ]
        };
        let ratio = S::constant(RATIO_DRIFT) * (self.roughness.of_ratio() * rim_travel).sqrt();
        let nominal = S::constant(ANGLE_DRIFT * ANGLE_DRIFT) * travel;
        let met = S::constant(FRONT_FROM_FORCES) * readings.runs_of_forces;
        let left = nominal * beside_trend(BESIDE_TREND, restless);
        let alone = of_front_alone(&self.angles(), &self.variances);
        self.drift_variances = [left * (factor + alone) + nominal * met, beside_track * left * factor];
        let truly = self.turned_back;
        let [front, others] = self.drift_variances.map(|drift| drift + truly);
        let pitch = S::constant(PITCH_DRIFT) * travel.sqrt() + shifts_rad;
        let [middle, rear] = unlike.map(|unlike| (others + unlike * unlike).sqrt());
        let noise = [ratio, front.sqrt(), middle, rear, pitch, pitch, step_s * rate_std_rad_s];
        let _ = self.filter.predict(process, &noise);
    }
}
