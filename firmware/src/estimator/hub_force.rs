//! Filter 2, second half: the forces on the hubs of a side, from load cells and moments.
//!
//! State: the force along each cell's axis on front, middle and rear hub, the force along the rocker on the front hub, and
//! that along the bogie on its two hubs together. In these directions everything that is measured is a sum of states: the
//! cells, the moment on the bogie and the moment on the rocker. What the two hubs of a bogie have of their joint force
//! is not observable where they hang at the same height, so it is no state: it comes in as a split with a spread.
//! Normal load and drawbar pull are these forces seen along the contact ([`super::drawbar_split`]).
//!
//! All this is linear, so that the filter need not know the forces, but what they have beyond those of a rover at rest: in single precision
//! the moments of some 67 N on each arm, which nearly balance, would leave little of what the drives' noise allows to be told.
//!
//! What drifts by itself are the cells' forces and the two moments. The links have no mass to speak of: whatever the ground does,
//! the moments on them stay what torques and body make them, so that a cell's force that changes takes the forces along the
//! links with it, and so does a bogie that turns against its rocker. The drift of the state is therefore correlated.

use super::runs::Runs;
use super::scale::Scale;
use super::slip_torque::TORQUE_DRIFT_NM;
use super::trend::{Trends, beside_trend, restlessness};
use super::walk_rate::{Noise, WalkRate};
use super::watch::{Contradiction, Watch};
use crate::filter::{Gaussian, Innovation, SigmaPointFilter};
use crate::rover::{PerAxle, Planar, Rover, Suspension};
use crate::scalar::Scalar;

/// States: cell forces of front, middle and rear; along the rocker on the front hub; along the bogie on both its hubs, N.
pub const STATES: usize = 5;
/// Measurements: three cells, N; moment on the bogie; moment on the rocker, N·m.
pub const MEASUREMENTS: usize = 5;

/// What ties the forces to the measurements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HubForceModel<S> {
    /// Front hub from the differential axis, in the rocker's coordinates, m.
    pub front_hub: Planar<S>,
    /// Bogie pivot from the differential axis, in the rocker's coordinates, m.
    pub bogie_pivot: Planar<S>,
    /// Middle hub from the pivot, in the bogie's coordinates, m.
    pub middle_hub: Planar<S>,
    /// Rear hub from the pivot, in the bogie's coordinates, m.
    pub rear_hub: Planar<S>,
    /// Sine and cosine of the bogie's angle against the rocker.
    pub bogie_angle: (S, S),
    /// Force along the bogie on the middle hub less that on the rear hub, N: the split, an input.
    pub difference_n: S,
}

impl<S: Scalar> HubForceModel<S> {
    /// The model of either side, with its bogie at an angle to the rocker of which sine and cosine are given, and no
    /// difference between its wheels.
    pub fn new(suspension: &Suspension<S>, bogie_angle: (S, S)) -> Self {
        Self {
            front_hub: suspension.front_hub,
            bogie_pivot: suspension.bogie_pivot,
            middle_hub: suspension.middle_hub,
            rear_hub: suspension.rear_hub,
            bogie_angle,
            difference_n: S::zero(),
        }
    }

    /// What the sensors see of the forces: the cells, then the moments of the soil's forces on bogie and rocker about pivot
    /// and axis, positive nose-down.
    pub fn measure(&self, state: &[S; STATES]) -> [S; MEASUREMENTS] {
        let forces = self.forces(state);
        let bogie = self.middle_hub.moment_nm(forces.middle) + self.rear_hub.moment_nm(forces.rear);
        let on_pivot = (forces.middle + forces.rear).turned(self.bogie_angle);
        let rocker = self.front_hub.moment_nm(forces.front) + self.bogie_pivot.moment_nm(on_pivot);
        let [front, middle, rear, _, _] = *state;
        [front, middle, rear, bogie, rocker]
    }

    /// Moments on bogie and rocker, N·m, of this force along each cell and none along the links: what [`Self::measure`] gives, without the
    /// difference of large arms, of which single precision would keep little.
    fn moments_of(&self, force_n: S) -> [S; 2] {
        let two = S::constant(2.0);
        let (sine, cosine) = self.bogie_angle;
        let (pivot, level) = (self.bogie_pivot, self.front_hub.x + two * self.bogie_pivot.x);
        let turned = pivot.x * sine * sine / (S::one() + cosine) - pivot.z * sine;
        [-(self.middle_hub.x + self.rear_hub.x) * force_n, (two * turned - level) * force_n]
    }

    /// The state that such cells' forces, N, and moments on bogie and rocker, N·m, make necessary: [`Self::measure`] turned round.
    fn state_of(&self, &[front, middle, rear, bogie_nm, rocker_nm]: &[S; MEASUREMENTS]) -> [S; STATES] {
        let (zero, one) = (S::zero(), S::one());
        let straight = Self { difference_n: zero, ..*self };
        let [.., arm_of_bogie, of_bogie] = straight.measure(&[zero, zero, zero, zero, one]);
        let [.., arm_of_rocker] = straight.measure(&[zero, zero, zero, one, zero]);
        let [.., bogie_by_cells, rocker_by_cells] = self.measure(&[front, middle, rear, zero, zero]);
        let along_bogie = (bogie_nm - bogie_by_cells) / arm_of_bogie;
        [front, middle, rear, (rocker_nm - rocker_by_cells - of_bogie * along_bogie) / arm_of_rocker, along_bogie]
    }

    /// The force on each hub in the coordinates of its link, N.
    pub fn forces(&self, [front, middle, rear, along_rocker, along_bogie]: &[S; STATES]) -> PerAxle<Planar<S>> {
        let half = S::constant(0.5);
        PerAxle {
            front: Planar { x: *along_rocker, z: *front },
            middle: Planar { x: half * (*along_bogie + self.difference_n), z: *middle },
            rear: Planar { x: half * (*along_bogie - self.difference_n), z: *rear },
        }
    }
}

/// What is measured of a side.
#[derive(Debug, Clone, Copy)]
pub(super) struct ForceReadings<S> {
    /// The load cells, N.
    pub cells_n: PerAxle<Option<S>>,
    /// One standard deviation of a cell, N.
    pub cell_std_n: S,
    /// Whether a wheel of the bogie hangs in the air. Then a stop holds the bogie, and no moment about its pivot is known.
    pub bogie_is_held: bool,
    /// Moment of the soil's forces on the bogie, N·m, with one standard deviation: what its resistive torques balance.
    pub bogie_moment_nm: (S, S),
    /// Moment of the soil's forces on the rocker, N·m, with one standard deviation: what the front wheel's torque and half
    /// the body balance.
    pub rocker_moment_nm: (S, S),
}

/// One standard deviation of a force that is not known at all, over the rover's weight.
const UNKNOWN_SHARE: f64 = 0.3;
/// Nominal drift of a cell's force over a metre of travel, N: 6 N over a wheel radius. Like all forces and torques here it is of set K0,
/// and goes with the [scale](Scale) of a rover.
const CELL_DRIFT_N: f64 = 21.0;
/// The same of the moments, N·m: on the rocker that of one wheel's torque (the body's share wanders less), on the bogie that of two.
const ROCKER_DRIFT_NM: f64 = TORQUE_DRIFT_NM;
const BOGIE_DRIFT_NM: f64 = core::f64::consts::SQRT_2 * TORQUE_DRIFT_NM;
/// What of the drift is left beside what goes on by its trend, as a variance, on restless ground: with all of it innovations have
/// nine tenths of the variance that they are stated to have.
const BESIDE_TREND: f64 = 0.4;
/// The share of an update's way that counts as the trend's, over the gain of the filter.
const LEARNED: f64 = 0.4;
/// What wheels that stand or have just started leave unknown of the forces of their side in each frame, N.
const UNSETTLED_N: f64 = 3.0;

/// The greatest force along a bogie over the forces on its cells: more is no soil's doing.
const GREATEST_SHARE: f64 = 0.8;
/// What is known of a pull of which nothing is told: none, give or take this much, N.
const FORGOTTEN_PULL_N: f64 = 15.0;

/// The filter of one side. It knows the cells' forces, and what is measured, less what a level rover at rest has: these are an order of
/// magnitude smaller, and so is what single precision rounds off them.
#[derive(Debug, Clone)]
pub(super) struct HubForceFilter<S> {
    filter: SigmaPointFilter<S, STATES>,
    /// The force along each cell of a level rover at rest, N.
    at_rest_n: S,
    model: HubForceModel<S>,
    /// What [`Self::at_rest_n`] makes the moments on bogie and rocker, N·m.
    at_rest_nm: [S; 2],
    unknown_n: S,
    scale: Scale<S>,
    cell_rates: PerAxle<WalkRate<S>>,
    rocker_rate: WalkRate<S>,
    bogie_rate: WalkRate<S>,
    watch: Watch<MEASUREMENTS>,
    runs: Runs<S, MEASUREMENTS>,
    /// Of the cells' forces. The moments have none that would be worth following.
    trends: Trends<S, 3>,
}

impl<S: Scalar> HubForceFilter<S> {
    /// A filter that knows the rover's weight.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn new(rover: &Rover<S>, phase: usize) -> Self {
        let weight = rover.mass_kg * rover.gravity_m_s2;
        let unknown_n = weight * S::constant(UNKNOWN_SHARE);
        let model = HubForceModel::new(&rover.suspension, (S::zero(), S::one()));
        let at_rest_n = rover.load_at_rest_n();
        Self {
            filter: SigmaPointFilter::unknowing([S::zero(); STATES], [unknown_n; STATES]),
            at_rest_n,
            at_rest_nm: model.moments_of(at_rest_n),
            model,
            unknown_n,
            scale: Scale::of(rover),
            cell_rates: PerAxle::from_array([phase, phase + 1, phase + 2]).map(WalkRate::new),
            rocker_rate: WalkRate::new(phase + 3),
            bogie_rate: WalkRate::new(phase + 4),
            watch: Watch::new(),
            runs: Runs::new(),
            trends: Trends::new(),
        }
    }

    /// What is known of the state, less [`Self::at_rest_n`] of the cells' forces.
    pub fn estimate(&self) -> &Gaussian<S, STATES> {
        self.filter.estimate()
    }

    /// The runs of its innovations.
    pub fn runs(&self) -> &Runs<S, MEASUREMENTS> {
        &self.runs
    }

    /// The force on each hub at the mean, in the coordinates of its link, N.
    pub fn forces_n(&self) -> PerAxle<Planar<S>> {
        self.forces_at(self.filter.estimate())
    }

    /// The same of another estimate of its state.
    pub fn forces_at(&self, estimate: &Gaussian<S, STATES>) -> PerAxle<Planar<S>> {
        self.model.forces(estimate.mean()).map(|force| Planar { z: self.at_rest_n + force.z, ..force })
    }

    /// The force along each cell at the mean, N.
    pub fn cells_n(&self) -> PerAxle<S> {
        self.beyond_rest_n().map(|force| self.at_rest_n + force)
    }

    pub fn beyond_rest_n(&self) -> PerAxle<S> {
        let [front, middle, rear, ..] = *self.filter.estimate().mean();
        PerAxle { front, middle, rear }
    }

    /// How often the filter fell back to its floor, and how often it gave up what it believed.
    pub fn troubles(&self) -> (u32, u32) {
        (self.filter.resets(), self.watch.relearned())
    }

    /// A wheel stands or has just started: the forces are not what they were a frame ago.
    pub fn unsettle(&mut self) {
        self.trends.forget();
        self.loosen(self.scale.force_n(UNSETTLED_N));
    }

    fn loosen(&mut self, std_n: S) {
        let _ = self.filter.random_walk(&[std_n; STATES]);
    }

    /// The wheels roll as they will.
    pub fn settle(&mut self) {
        self.trends.forget();
        let rates = self.cell_rates.as_array_mut().into_iter().chain([&mut self.rocker_rate, &mut self.bogie_rate]);
        rates.for_each(WalkRate::restart);
    }

    /// Lets the forces drift over a step of so much time and travel, and takes what was measured with the bogie at an angle to the rocker and such a
    /// difference between its wheels, as the torques tell it, N.
    pub fn tick(
        &mut self,
        (step_s, travel_m): (S, S),
        bogie_angle_rad: S,
        difference_n: S,
        readings: &ForceReadings<S>,
    ) -> Innovation<S, MEASUREMENTS> {
        let before = self.model;
        self.model.bogie_angle = bogie_angle_rad.sin_cos();
        self.model.difference_n = difference_n;
        let [_, before_nm] = self.at_rest_nm;
        self.at_rest_nm = self.model.moments_of(self.at_rest_n);
        let held = readings.bogie_is_held || self.is_impossible(readings);
        if held {
            self.give_up_moments();
        }
        self.learn_rates((step_s, travel_m), readings, held);
        let drifts = self.drift(&before, before_nm, travel_m, held);
        let expected = self.beyond_rest_n();
        let model = self.model;
        let cells = readings.cells_n.map(|cell| cell.map(|force| force - self.at_rest_n));
        let [bogie_at_rest, rocker_at_rest] = self.at_rest_nm;
        let told = self.filter.update(
            |state| model.measure(state),
            &[
                cells.front,
                cells.middle,
                cells.rear,
                Some(readings.bogie_moment_nm.0 - bogie_at_rest).filter(|_| !held),
                Some(readings.rocker_moment_nm.0 - rocker_at_rest).filter(|_| !held),
            ],
            &[
                readings.cell_std_n,
                readings.cell_std_n,
                readings.cell_std_n,
                readings.bogie_moment_nm.1,
                readings.rocker_moment_nm.1,
            ],
            self.watch.gate(),
        );
        self.runs.take(&told, 0);
        self.follow_trends(travel_m, &expected, &drifts, readings);
        match self.watch.judge(&told) {
            Contradiction::Passing => {}
            Contradiction::Moved => self.unsettle(),
            Contradiction::Wrong => self.loosen(self.unknown_n),
        }
        told
    }

    /// Carries the forces to the model of this frame: what lasts as a bogie turns is what the cells feel, which goes on by its trend, and
    /// the moments, not the forces along the links. Where a stop holds the bogie, its moments are nobody's. Gives one standard
    /// deviation of how far each may drift beside that.
    fn drift(&mut self, before: &HubForceModel<S>, before_nm: S, travel_m: S, held: bool) -> [S; MEASUREMENTS] {
        let restless = self.cell_rates.as_ref().map(|rate| restlessness(rate.factor()));
        self.trends.expect(restless.into_array());
        let (now, mean) = (self.model, *self.filter.estimate().mean());
        let mut expected = before.measure(&mean);
        // What a force at rest does to the rocker hangs on the bogie's angle; to the bogie it does the same at any.
        let ([.., of_rocker], [_, now_nm]) = (&mut expected, self.at_rest_nm);
        *of_rocker += before_nm - now_nm;
        expected.iter_mut().zip(self.trends.per_m()).for_each(|(force, trend)| *force += travel_m * trend);
        let mean = if held { mean } else { now.state_of(&expected) };
        let straight = |model: &HubForceModel<S>| HubForceModel { difference_n: S::zero(), ..*model };
        let (before, now) = (straight(before), straight(&now));
        let drifts = self.drifts(travel_m);
        let _ = self.filter.random_walk_in(|state| before.measure(state), |told| now.state_of(told), mean, &drifts);
        drifts
    }

    fn follow_trends(
        &mut self,
        travel_m: S,
        expected: &PerAxle<S>,
        drifts: &[S; MEASUREMENTS],
        readings: &ForceReadings<S>,
    ) {
        let [front, middle, rear, ..] = *drifts;
        // With a steady gain well below one, the drift's standard deviation is to that of the noise as that gain is to one.
        let learned = S::constant(LEARNED) / readings.cell_std_n;
        let moved = self.beyond_rest_n().zip(*expected).zip(PerAxle { front, middle, rear });
        let moved = moved.map(|((now, before), drift)| (now - before, learned * drift));
        let told = readings.cells_n.map(|cell| cell.is_some());
        self.trends.follow(travel_m, &moved.into_array(), told.into_array());
    }

    /// One standard deviation of how far each cell's force, N, and the moments on bogie and rocker, N·m, drift over some travel.
    fn drifts(&self, travel_m: S) -> [S; MEASUREMENTS] {
        let drift = |nominal: f64, travel_m: S, rate: &WalkRate<S>| {
            let factor = rate.factor();
            let beside = beside_trend(BESIDE_TREND, restlessness(factor));
            S::constant(nominal) * (travel_m * factor * beside).sqrt()
        };
        let [of_cells, of_moments] = self.scale.travels_m(travel_m);
        let PerAxle { front, middle, rear } = self.cell_rates.as_ref().map(|rate| drift(CELL_DRIFT_N, of_cells, rate));
        let of_bogie = drift(BOGIE_DRIFT_NM, of_moments, &self.bogie_rate);
        let of_rocker = drift(ROCKER_DRIFT_NM, of_moments, &self.rocker_rate);
        [front, middle, rear, of_bogie, of_rocker]
    }

    /// Whether the moment on the bogie and its cells make a force along it necessary that no two wheels under such loads can have:
    /// then something else holds the bogie.
    fn is_impossible(&self, readings: &ForceReadings<S>) -> bool {
        let PerAxle { middle: Some(middle), rear: Some(rear), .. } = readings.cells_n else { return false };
        let [bogie_at_rest, _] = self.at_rest_nm;
        let beyond = |force: S| force - self.at_rest_n;
        let bogie_nm = readings.bogie_moment_nm.0 - bogie_at_rest;
        let told = [S::zero(), beyond(middle), beyond(rear), bogie_nm, S::zero()];
        let [.., along_bogie] = self.model.state_of(&told);
        let loads = middle.abs() + rear.abs();
        along_bogie.abs() > S::constant(GREATEST_SHARE) * loads.max(self.scale.force_n(FORGOTTEN_PULL_N))
    }

    /// Forgets the forces that only the moments tell.
    fn give_up_moments(&mut self) {
        for index in [3, 4] {
            let _ = self.filter.forget(index, S::zero(), self.scale.force_n(FORGOTTEN_PULL_N));
        }
    }

    /// Learns how fast the cells' forces and the moments wander. Where a stop holds the bogie the moments are not the soil's.
    fn learn_rates(&mut self, (step_s, travel_m): (S, S), readings: &ForceReadings<S>, held: bool) {
        let nominal = |drift: f64, travel_m: S| S::constant(drift * drift) * travel_m;
        let [of_cells, of_moments] = self.scale.travels_m(travel_m);
        let of_cell = nominal(CELL_DRIFT_N, of_cells);
        for (rate, cell) in self.cell_rates.as_array_mut().into_iter().zip(readings.cells_n.as_array()) {
            rate.take(*cell, Noise::white(readings.cell_std_n), of_cell, step_s);
        }
        let moments = [
            (&mut self.bogie_rate, readings.bogie_moment_nm, nominal(BOGIE_DRIFT_NM, of_moments)),
            (&mut self.rocker_rate, readings.rocker_moment_nm, nominal(ROCKER_DRIFT_NM, of_moments)),
        ];
        for (rate, (moment, std), nominal) in moments {
            rate.take(Some(moment).filter(|_| !held), Noise::white(std), nominal, step_s);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::HubForceModel;
    use crate::rover::Rover;

    /// The state that cells and moments make necessary must be measured as just these.
    #[test]
    fn cells_and_moments_make_one_state_necessary() {
        let rover = Rover::<f64>::assumed();
        let bogie_angle: f64 = 0.2;
        let model = HubForceModel { difference_n: 3.0, ..HubForceModel::new(&rover.suspension, bogie_angle.sin_cos()) };
        let told = [70.0, 55.0, 80.0, 3.0, -1.5];
        let measured = model.measure(&model.state_of(&told));
        assert!(measured.iter().zip(told).all(|(found, told)| (found - told).abs() < 1.0e-9), "{measured:?}");
    }

    #[test]
    fn a_force_at_rest_has_the_moments_that_are_measured_of_it() {
        let rover = Rover::<f64>::assumed();
        let mut suspension = rover.suspension;
        (suspension.front_hub.x, suspension.rear_hub.x) = (0.31, -0.2);
        let bogie_angle: f64 = -0.3;
        let model = HubForceModel::new(&suspension, bogie_angle.sin_cos());
        let [.., bogie, rocker] = model.measure(&[67.0, 67.0, 67.0, 0.0, 0.0]);
        let [of_bogie, of_rocker] = model.moments_of(67.0);
        assert!((of_bogie - bogie).abs() < 1.0e-12 && (of_rocker - rocker).abs() < 1.0e-12, "{of_bogie} {of_rocker}");
    }
}
