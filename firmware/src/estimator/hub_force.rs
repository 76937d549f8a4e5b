//! Filter 2, second half: the forces on the hubs of a side, from load cells and moments.
//!
//! State: the force along each cell's axis on front, middle and rear hub, the force along the rocker on the front hub, and
//! that along the bogie on its two hubs together. In these directions everything that is measured is a sum of states: the
//! cells, the moment on the bogie and the moment on the rocker. What the two hubs of a bogie have of their joint force
//! is not observable where they hang at the same height, so it is no state: it comes in as a split with a spread.
//! Normal load and drawbar pull are these forces seen along the contact ([`super::drawbar_split`]).

use super::walk_rate::WalkRate;
use super::watch::{Contradiction, Watch};
use crate::filter::{Gate, Gaussian, Innovation, InvalidNumber, SigmaPointFilter};
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
/// Nominal drift of a cell's force over a metre of travel, N: 6 N over a wheel radius.
const CELL_DRIFT_N: f64 = 21.0;
/// The same of the forces along rocker and bogie, N.
const ALONG_DRIFT_N: f64 = 15.0;
/// What wheels that stand or have just started leave unknown of the forces of their side in each frame, N.
const UNSETTLED_N: f64 = 3.0;

/// The greatest force along a bogie over the forces on its cells: more is no soil's doing.
const GREATEST_SHARE: f64 = 0.8;
/// What is known of a pull of which nothing is told: none, give or take this much, N.
const FORGOTTEN_PULL_N: f64 = 15.0;

/// The filter of one side.
#[derive(Debug, Clone)]
pub(super) struct HubForceFilter<S> {
    filter: SigmaPointFilter<S, STATES>,
    model: HubForceModel<S>,
    unknown_n: S,
    cell_rates: PerAxle<WalkRate<S>>,
    rocker_rate: WalkRate<S>,
    bogie_rate: WalkRate<S>,
    watch: Watch,
}

impl<S: Scalar> HubForceFilter<S> {
    /// A filter that knows the rover's weight.
    pub fn new(rover: &Rover<S>, phase: usize) -> Result<Self, InvalidNumber> {
        let weight = rover.mass_kg * rover.gravity_m_s2;
        let (load, unknown_n) = (weight * S::constant(1.0 / 6.0), weight * S::constant(UNKNOWN_SHARE));
        let estimate = Gaussian::independent([load, load, load, S::zero(), S::zero()], [unknown_n; STATES])?;
        let model = HubForceModel::new(&rover.suspension, (S::zero(), S::one()));
        Ok(Self {
            filter: SigmaPointFilter::new(estimate, [unknown_n; STATES])?,
            model,
            unknown_n,
            cell_rates: PerAxle::from_array([phase, phase + 1, phase + 2]).map(WalkRate::new),
            rocker_rate: WalkRate::new(phase + 3),
            bogie_rate: WalkRate::new(phase + 4),
            watch: Watch::default(),
        })
    }

    /// What is known of the state.
    pub fn estimate(&self) -> &Gaussian<S, STATES> {
        self.filter.estimate()
    }

    /// The force on each hub at the mean, in the coordinates of its link, N.
    pub fn forces_n(&self) -> PerAxle<Planar<S>> {
        self.forces_at(self.filter.estimate())
    }

    /// The same of another estimate of its state.
    pub fn forces_at(&self, estimate: &Gaussian<S, STATES>) -> PerAxle<Planar<S>> {
        self.model.forces(estimate.mean())
    }

    /// The force along each cell at the mean, N.
    pub fn cells_n(&self) -> PerAxle<S> {
        let [front, middle, rear, ..] = *self.filter.estimate().mean();
        PerAxle { front, middle, rear }
    }

    /// How often the filter fell back to its floor.
    pub fn resets(&self) -> u32 {
        self.filter.resets()
    }

    /// How often it gave up what it believed.
    pub fn relearned(&self) -> u32 {
        self.watch.relearned()
    }

    /// A wheel stands or has just started: the forces are not what they were a frame ago.
    pub fn unsettle(&mut self) {
        self.loosen(S::constant(UNSETTLED_N));
    }

    fn loosen(&mut self, std_n: S) {
        let _ = self.filter.random_walk(&[std_n; STATES]);
    }

    /// The wheels roll as they will.
    pub fn settle(&mut self) {
        let rates = self.cell_rates.as_array_mut().into_iter().chain([&mut self.rocker_rate, &mut self.bogie_rate]);
        rates.for_each(WalkRate::restart);
    }

    /// Takes the split that the torques tell.
    pub fn split(&mut self, difference_n: S) {
        self.model.difference_n = difference_n;
    }

    /// Lets the forces drift over so much travel, and takes what was measured with the bogie at an angle to the rocker.
    pub fn tick(
        &mut self,
        travel_m: S,
        bogie_angle_rad: S,
        readings: &ForceReadings<S>,
    ) -> Innovation<S, MEASUREMENTS> {
        self.model.bogie_angle = bogie_angle_rad.sin_cos();
        let along_bogie = self.along_bogie(readings);
        let held = readings.bogie_is_held || along_bogie.is_some_and(|(force, _)| self.is_impossible(force, readings));
        if held {
            self.give_up_moments();
        }
        self.learn_rates(travel_m, readings, along_bogie.filter(|_| !held));
        let _ = self.filter.random_walk(&self.drifts_n(travel_m));
        let model = self.model;
        let told = self.filter.update(
            |state| model.measure(state),
            &[
                readings.cells_n.front,
                readings.cells_n.middle,
                readings.cells_n.rear,
                Some(readings.bogie_moment_nm.0).filter(|_| !held),
                Some(readings.rocker_moment_nm.0).filter(|_| !held),
            ],
            &[
                readings.cell_std_n,
                readings.cell_std_n,
                readings.cell_std_n,
                readings.bogie_moment_nm.1,
                readings.rocker_moment_nm.1,
            ],
            Gate::one_in_a_thousand(),
        );
        match self.watch.judge(&told) {
            Contradiction::Passing => {}
            Contradiction::Moved => self.unsettle(),
            Contradiction::Wrong => self.loosen(self.unknown_n),
        }
        told
    }

    /// One standard deviation of how far each force drifts over some travel, N.
    fn drifts_n(&self, travel_m: S) -> [S; STATES] {
        let root_travel = travel_m.sqrt();
        let drift = |nominal: f64, rate: &WalkRate<S>| S::constant(nominal) * root_travel * rate.factor().sqrt();
        let PerAxle { front, middle, rear } = self.cell_rates.as_ref().map(|rate| drift(CELL_DRIFT_N, rate));
        [front, middle, rear, drift(ALONG_DRIFT_N, &self.rocker_rate), drift(ALONG_DRIFT_N, &self.bogie_rate)]
    }

    /// The force along the bogie on its two hubs together that the moment on it and its cells make necessary, N, and its
    /// variance.
    fn along_bogie(&self, readings: &ForceReadings<S>) -> Option<(S, S)> {
        let (middle, rear) = (readings.cells_n.middle?, readings.cells_n.rear?);
        // The moment without the forces along it is what the cells' arms make; their height is the lever arm.
        let [_, _, _, by_cells, _] = self.model.measure(&[S::zero(), middle, rear, S::zero(), S::zero()]);
        let arm = S::constant(0.5) * (self.model.middle_hub.z + self.model.rear_hub.z);
        let force = (readings.bogie_moment_nm.0 - by_cells) / arm;
        let square = |value: S| value * value;
        let cells = square(self.model.middle_hub.x) + square(self.model.rear_hub.x);
        let variance = square(readings.cell_std_n) * cells + square(readings.bogie_moment_nm.1);
        Some((force, variance / square(arm)))
    }

    /// Whether no two wheels under such loads are pushed so along their bogie: then something else holds the bogie.
    fn is_impossible(&self, along_bogie_n: S, readings: &ForceReadings<S>) -> bool {
        let load = |cell: Option<S>| cell.unwrap_or(S::zero()).abs();
        let loads = load(readings.cells_n.middle) + load(readings.cells_n.rear);
        along_bogie_n.abs() > S::constant(GREATEST_SHARE) * loads.max(S::constant(FORGOTTEN_PULL_N))
    }

    /// Forgets the forces that only the moments tell.
    fn give_up_moments(&mut self) {
        for index in [3, 4] {
            let _ = self.filter.forget(index, S::zero(), S::constant(FORGOTTEN_PULL_N));
        }
    }

    /// Learns how fast the forces wander, from the cells, and from the moments with the forces that the cells tell.
    fn learn_rates(&mut self, travel_m: S, readings: &ForceReadings<S>, along_bogie: Option<(S, S)>) {
        let [of_cell, nominal] = [CELL_DRIFT_N, ALONG_DRIFT_N].map(|drift| S::constant(drift * drift) * travel_m);
        let variance = readings.cell_std_n * readings.cell_std_n;
        let cells = self.cell_rates.as_array_mut().into_iter().zip(readings.cells_n.as_array());
        for (rate, cell) in cells {
            match cell {
                Some(force) => rate.see(*force, variance, of_cell),
                None => rate.miss(of_cell),
            }
        }
        match along_bogie {
            Some((force, variance)) => self.bogie_rate.see(force, variance, nominal),
            None => self.bogie_rate.miss(nominal),
        }
        match along_bogie.and_then(|force| self.along_rocker(readings, force)) {
            Some((force, variance)) => self.rocker_rate.see(force, variance, nominal),
            None => self.rocker_rate.miss(nominal),
        }
    }

    /// The force along the rocker on the front hub that the moment on it makes necessary, N, and its variance.
    fn along_rocker(&self, readings: &ForceReadings<S>, along_bogie: (S, S)) -> Option<(S, S)> {
        let PerAxle { front: Some(front), middle: Some(middle), rear: Some(rear) } = readings.cells_n else {
            return None;
        };
        let [_, _, _, _, by_others] = self.model.measure(&[front, middle, rear, S::zero(), along_bogie.0]);
        let (arm, pivot) = (self.model.front_hub.z, self.model.bogie_pivot);
        let square = |value: S| value * value;
        let cells = square(self.model.front_hub.x) + square(pivot.x) + square(pivot.x);
        let variance =
            square(readings.cell_std_n) * cells + square(readings.rocker_moment_nm.1) + along_bogie.1 * square(pivot.z);
        Some(((readings.rocker_moment_nm.0 - by_others) / arm, variance / square(arm)))
    }
}
