//! What ties the forces on the hubs of a side to its load cells and to the moments on its links.
//!
//! In directions along and across the links everything that is measured is a sum of states: the cells, the moment on the bogie and the moment
//! on the rocker. What the two hubs of a bogie have of their joint force is not observable where they hang at the same height, so it is
//! no state: it comes in as a split.

use crate::rover::{PerAxle, Planar, Suspension};
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
    pub(super) fn moments_of(&self, force_n: S) -> [S; 2] {
        let two = S::constant(2.0);
        let (sine, cosine) = self.bogie_angle;
        let (pivot, level) = (self.bogie_pivot, self.front_hub.x + two * self.bogie_pivot.x);
        let turned = pivot.x * sine * sine / (S::one() + cosine) - pivot.z * sine;
        [-(self.middle_hub.x + self.rear_hub.x) * force_n, (two * turned - level) * force_n]
    }

    /// The state that such cells' forces, N, and moments on bogie and rocker, N·m, make necessary: [`Self::measure`] turned round.
    pub(super) fn state_of(&self, &[front, middle, rear, bogie_nm, rocker_nm]: &[S; MEASUREMENTS]) -> [S; STATES] {
        let arm_of_bogie = S::constant(0.5) * (self.middle_hub.z + self.rear_hub.z);
        let along_on_pivot = Planar::direction(self.bogie_angle);
        let [.., bogie_by_cells, rocker_by_cells] = self.measure(&[front, middle, rear, S::zero(), S::zero()]);
        let along_bogie = (bogie_nm - bogie_by_cells) / arm_of_bogie;
        let rocker_by_all = rocker_by_cells + self.bogie_pivot.moment_nm(along_on_pivot) * along_bogie;
        [front, middle, rear, (rocker_nm - rocker_by_all) / self.front_hub.z, along_bogie]
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
