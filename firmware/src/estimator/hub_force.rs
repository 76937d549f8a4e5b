//! Filter 2, second half: the forces on the hubs of a side, from load cells and moments.
//!
//! State: the force along each cell's axis on front, middle and rear hub, the force along the rocker on the front hub, and
//! that along the bogie on its two hubs together ([`HubForceModel`]). Normal load and drawbar pull are these forces seen
//! along the contact ([`super::drawbar_split`]).
//!
//! All this is linear, so that the filter need not know the forces, but what they have beyond those of a rover at rest: in single precision
//! the moments of some 67 N on each arm, which nearly balance, would leave little of what the drives' noise allows to be told.
//!
//! What drifts by itself are the cells' forces and the two moments. The links have no mass to speak of: whatever the ground does,
//! the moments on them stay what torques and body make them, so that a cell's force that changes takes the forces along the
//! links with it, and so does a bogie that turns against its rocker. The drift of the state is therefore correlated.

use super::bogie_stop::AlongLinks;
pub use super::hub_force_model::{HubForceModel, MEASUREMENTS, STATES};
use super::runs::Runs;
use super::scale::Scale;
use super::slip_torque::TORQUE_DRIFT_NM;
use super::trend::{Trends, beside_trend, restlessness};
use super::troubles::Troubles;
use super::walk_rate::{Noise, WalkRate};
use super::watch::{Contradiction, Watch};
use crate::filter::{Fate, Gaussian, Innovation, SigmaPointFilter};
use crate::rover::{PerAxle, Planar, Rover};
use crate::scalar::Scalar;

/// What is measured of a side.
#[derive(Debug, Clone, Copy)]
pub(super) struct ForceReadings<S> {
    /// The load cells, N.
    pub cells_n: PerAxle<Option<S>>,
    /// One standard deviation of a cell, N.
    pub cell_std_n: S,
    /// Whether a wheel of the bogie hangs in the air.
    pub bogie_hangs: bool,
    /// Whether the wheels of the side roll: none stands, and none is blocked.
    pub all_roll: bool,
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
/// One standard deviation of what the torques tell of the force along a link, N.
const TOLD_BY_TORQUE_N: f64 = 8.0;

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
    /// Whether a stop holds the bogie: then its moments are nobody's.
    held: bool,
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
            held: false,
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

    /// The force along each cell at the mean, less [`Self::at_rest_n`], N.
    pub fn beyond_rest_n(&self) -> PerAxle<S> {
        let [front, middle, rear, ..] = *self.filter.estimate().mean();
        PerAxle { front, middle, rear }
    }

    /// Whether a stop held the bogie in the last frame: then its moments are nobody's.
    pub fn bogie_is_held(&self) -> bool {
        self.held
    }

    /// How often the filter was in trouble.
    pub fn troubles(&self) -> Troubles {
        Troubles { resets: self.filter.resets(), relearned: self.watch.relearned() }
    }

    /// A wheel stands or has just started: the forces are not what they were a frame ago.
    pub fn unsettle(&mut self) {
        self.loosen(&[self.scale.force_n(UNSETTLED_N); STATES]);
    }

    /// The forces have moved: one whose cell is contradicted, by as far as the cell is from it. By less, it would go on to be contradicted
    /// while a wheel loses the ground, or comes down on it.
    fn jump(&mut self, told: &Innovation<S, MEASUREMENTS>) {
        let mut stds_n = [self.scale.force_n(UNSETTLED_N); STATES];
        let cells = stds_n.iter_mut().zip(&told.residuals).take(3);
        for (std_n, residual) in cells.filter(|(_, residual)| residual.fate == Fate::Rejected) {
            *std_n = residual.innovation.abs().max(*std_n).min(self.unknown_n);
        }
        self.loosen(&stds_n);
    }

    fn loosen(&mut self, stds_n: &[S; STATES]) {
        self.trends.forget();
        let _ = self.filter.random_walk(stds_n);
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
        along: &AlongLinks<S>,
        readings: &ForceReadings<S>,
    ) -> Innovation<S, MEASUREMENTS> {
        let before = self.model;
        self.model.bogie_angle = bogie_angle_rad.sin_cos();
        self.model.difference_n = along.difference_n;
        let [_, before_nm] = self.at_rest_nm;
        self.at_rest_nm = self.model.moments_of(self.at_rest_n);
        self.held = readings.all_roll && (readings.bogie_hangs || self.is_held(along, readings));
        if self.held {
            self.give_up_moments(along);
        }
        self.learn_rates((step_s, travel_m), readings);
        let drifts = self.drift(&before, before_nm, travel_m);
        let expected = self.beyond_rest_n();
        let (model, held) = (self.model, self.held);
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
            Contradiction::Moved => self.jump(&told),
            Contradiction::Wrong => self.loosen(&[self.unknown_n; STATES]),
        }
        told
    }

    /// Carries the forces to the model of this frame: what lasts as a bogie turns is what the cells feel, which goes on by its trend, and
    /// the moments, not the forces along the links. Where a stop holds the bogie, its moments are nobody's. Gives one standard
    /// deviation of how far each may drift beside that.
    fn drift(&mut self, before: &HubForceModel<S>, before_nm: S, travel_m: S) -> [S; MEASUREMENTS] {
        let restless = self.cell_rates.as_ref().map(|rate| restlessness(rate.factor()));
        self.trends.expect(restless.into_array());
        let (now, mean) = (self.model, *self.filter.estimate().mean());
        let mut expected = before.measure(&mean);
        // What a force at rest does to the rocker hangs on the bogie's angle; to the bogie it does the same at any.
        let ([.., of_rocker], [_, now_nm]) = (&mut expected, self.at_rest_nm);
        *of_rocker += before_nm - now_nm;
        expected.iter_mut().zip(self.trends.per_m()).for_each(|(force, trend)| *force += travel_m * trend);
        let mean = if self.held { mean } else { now.state_of(&expected) };
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

    /// Whether a stop holds the bogie, by the forces along the links that cells and moments of this frame make necessary.
    fn is_held(&self, along: &AlongLinks<S>, readings: &ForceReadings<S>) -> bool {
        let PerAxle { front: Some(front), middle: Some(middle), rear: Some(rear) } = readings.cells_n else {
            return false;
        };
        let [bogie_at_rest, rocker_at_rest] = self.at_rest_nm;
        let beyond = |force: S| force - self.at_rest_n;
        let bogie_nm = readings.bogie_moment_nm.0 - bogie_at_rest;
        let rocker_nm = readings.rocker_moment_nm.0 - rocker_at_rest;
        let [.., rocker_n, bogie_n] =
            self.model.state_of(&[beyond(front), beyond(middle), beyond(rear), bogie_nm, rocker_nm]);
        along.tell_a_stop([rocker_n, bogie_n], middle.abs() + rear.abs())
    }

    /// Forgets the forces that only the moments tell: the torques tell them less well.
    fn give_up_moments(&mut self, along: &AlongLinks<S>) {
        for (index, force_n) in [(3, along.rocker_n), (4, along.bogie_n)] {
            let _ = self.filter.forget(index, force_n, self.scale.force_n(TOLD_BY_TORQUE_N));
        }
    }

    /// Learns how fast the cells' forces and the moments wander. Where a stop holds the bogie the moments are not the soil's.
    fn learn_rates(&mut self, (step_s, travel_m): (S, S), readings: &ForceReadings<S>) {
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
            rate.take(Some(moment).filter(|_| !self.held), Noise::white(std), nominal, step_s);
        }
    }
}

#[cfg(test)]
mod tests;
