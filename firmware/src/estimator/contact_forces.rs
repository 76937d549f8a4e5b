//! Forces along the contacts, and how their errors hang on what the filters know.

use super::compaction::Correction;
use super::contact_angle;
use super::drawbar_split::OF_TORQUE;
use super::hub_force;
use super::hub_on_ground::HubOnGround;
use super::side_estimate::HubForces;
use super::side_estimator::SideEstimator;
use super::slip_torque::SlipTorqueFilter;
use crate::rover::{Axle, PerAxle};
use crate::scalar::Scalar;

/// Contact angle, load and drawbar pull of one wheel, with their errors.
pub(super) struct ContactForces<S> {
    /// Contact angle, rad.
    pub contact_angle_rad: S,
    /// Normal load, N.
    pub load_n: S,
    /// Drawbar pull, N.
    pub pull_n: S,
    /// Of contact angle, load and pull.
    pub errors: [ErrorOf<S>; 3],
}

/// What the error of a quantity is made of.
#[derive(Clone, Copy)]
pub(super) struct ErrorOf<S> {
    /// It by the states of the contact-angle filter.
    pub by_angles: ByAngles<S>,
    /// What the torques, and a memory of the terrain, leave of its variance by these.
    pub left: S,
    /// It by the states of the hub-force filter.
    pub by_forces: [S; hub_force::STATES],
    /// It by the split between the wheels of a bogie: one standard deviation, N.
    pub by_split: S,
}

/// A quantity by the states of the contact-angle filter.
type ByAngles<S> = [S; contact_angle::STATES];

impl<S: Scalar> SideEstimator<S> {
    /// The contacts, with the split of the bogie's pull that the torques tell now, and with what these tell of the contact angles.
    pub(super) fn contacts(&self, estimate: &HubForces<S>) -> PerAxle<ContactForces<S>> {
        let corrections = &self.corrections;
        let PerAxle { front, middle, rear } = self.on_ground(&self.forces.forces_at(estimate), corrections);
        let form = self.split_of_pull(&middle, &rear).std_n;
        let torque_variance = |filter: &SlipTorqueFilter<S>| {
            let [_, torque, _] = filter.estimate().variances();
            torque
        };
        let per_torque = S::constant(OF_TORQUE) / self.rover.wheel.radius_m;
        let of_torques = torque_variance(&self.wheels.middle) + torque_variance(&self.wheels.rear);
        let split = S::constant(0.5) * (form * form + per_torque * per_torque * of_torques).sqrt();
        let (of_middle, of_rear) = share_along_bogie(&middle, &rear);
        PerAxle {
            front: contact_forces(Axle::Front, &front, &corrections.front, of_front(&front), S::zero()),
            middle: contact_forces(Axle::Middle, &middle, &corrections.middle, of_middle, split),
            rear: contact_forces(Axle::Rear, &rear, &corrections.rear, of_rear, -split),
        }
    }
}

/// Forces along a contact.
fn contact_forces<S: Scalar>(
    axle: Axle,
    hub: &HubOnGround<S>,
    correction: &Correction<S>,
    [angle, load, pull]: [ByAngles<S>; 3],
    split: S,
) -> ContactForces<S> {
    let (zero, half) = (S::zero(), S::constant(0.5));
    let (sine, cosine) = hub.angle;
    let by_hub = |across: S, along: S| match axle {
        Axle::Front => [across, zero, zero, along, zero],
        Axle::Middle => [zero, across, zero, zero, half * along],
        Axle::Rear => [zero, zero, across, zero, half * along],
    };
    let Correction { of_path, left_of_angle, left_of_pull, by_pull, .. } = *correction;
    let left = of_path * of_path;
    // Where the force along the link is too large, an angle that the torque tells comes out too small, and the pull not as much too large:
    // as far as the torque tells the angle, it tells the pull as well, whatever the force along the link is taken for.
    let pull_of = |times: S| by_hub(times * sine, times * cosine);
    let error = |by_angles, left, by_forces, by_split| ErrorOf { by_angles, left, by_forces, by_split };
    ContactForces {
        contact_angle_rad: hub.contact_angle_rad,
        load_n: hub.wheel.load_n,
        pull_n: hub.drawbar_pull_n,
        errors: [
            error(angle, left * left_of_angle, pull_of(-by_pull), zero),
            error(load, left * left_of_angle, by_hub(cosine, -sine), -sine * split),
            error(pull, left * left_of_pull, pull_of(left_of_pull), cosine * split),
        ],
    }
}

/// How contact angle, load and pull of the front wheel hang on the contact angles: one that is steeper by dγ sees DP dγ less as load and
/// W dγ more as pull.
fn of_front<S: Scalar>(hub: &HubOnGround<S>) -> [ByAngles<S>; 3] {
    let (zero, one) = (S::zero(), S::one());
    let against_link = |entry: S| [zero, entry, zero, zero, -entry, zero, zero];
    let itself = [zero, one, zero, zero, zero, zero, zero];
    [itself, against_link(-hub.drawbar_pull_n), against_link(hub.wheel.load_n)]
}

/// The same of a bogie's wheels. The moments hold the sum of the forces along the bogie, the torques the difference of the drawbar pulls:
/// where one contact is steeper by dγ, its pull seems W dγ larger, and the forces along the bogie have to change by opposite amounts until
/// both pulls are larger by about half of that.
fn share_along_bogie<S: Scalar>(
    middle: &HubOnGround<S>,
    rear: &HubOnGround<S>,
) -> ([ByAngles<S>; 3], [ByAngles<S>; 3]) {
    let (zero, one) = (S::zero(), S::one());
    let row = |middle: S, rear: S| [zero, zero, middle, rear, zero, -(middle + rear), zero];
    let ((middle_sine, middle_cosine), (rear_sine, rear_cosine)) = (middle.angle, rear.angle);
    let both = middle_cosine + rear_cosine;
    let (by_middle, by_rear) = (middle.wheel.load_n / both, rear.wheel.load_n / both);
    let pull = row(by_middle * rear_cosine, by_rear * middle_cosine);
    let of_middle = row(by_middle * middle_sine - middle.drawbar_pull_n, -by_rear * middle_sine);
    let of_rear = row(-by_middle * rear_sine, by_rear * rear_sine - rear.drawbar_pull_n);
    (
        [[zero, zero, one, zero, zero, zero, zero], of_middle, pull],
        [[zero, zero, zero, one, zero, zero, zero], of_rear, pull],
    )
}

#[cfg(test)]
mod tests {
    use super::{HubOnGround, share_along_bogie};
    use crate::estimator::drawbar_split::{BogieWheel, along_contact};
    use crate::rover::Planar;

    /// Cells and the sum along the bogie are held, and the difference of the pulls: where a contact is taken to be steeper, the force along
    /// the bogie shifts between its wheels until that is so again. Loads and pulls must change by what is stated of them.
    #[test]
    fn a_steeper_contact_changes_the_forces_on_both_wheels_of_a_bogie() {
        let (cells, along, angles, steeper) = ([70.0, 50.0], [9.0, -3.0], [0.4, -0.2_f64], 1.0e-6);
        let forces = |angles: [f64; 2], shifted: f64| {
            let of = |cell, along, angle: f64| along_contact(Planar { x: along, z: cell }, angle.sin_cos());
            let [(load, pull), (other_load, other_pull)] =
                [of(cells[0], along[0] + shifted, angles[0]), of(cells[1], along[1] - shifted, angles[1])];
            [load, pull, other_load, other_pull]
        };
        let hub = |at: usize| {
            let angle = angles[at].sin_cos();
            let (load_n, drawbar_pull_n) = along_contact(Planar { x: along[at], z: cells[at] }, angle);
            let wheel = BogieWheel { load_n, rim_force_n: 0.0, slip: 0.0, direction: 1.0 };
            HubOnGround { wheel, drawbar_pull_n, contact_angle_rad: angles[at], angle }
        };
        let ([_, middle_load, middle_pull], [_, rear_load, rear_pull]) = share_along_bogie(&hub(0), &hub(1));
        let before = forces(angles, 0.0);
        for (state, angles) in [(2, [angles[0] + steeper, angles[1]]), (3, [angles[0], angles[1] + steeper])] {
            let off = |shifted: f64| {
                let [_, pull, _, other_pull] = forces(angles, shifted);
                pull - other_pull - (before[1] - before[3])
            };
            // The difference is linear in what is shifted.
            let shifted = -off(0.0) / (off(1.0) - off(0.0));
            let after = forces(angles, shifted);
            let stated = [middle_load, middle_pull, rear_load, rear_pull].map(|row| row[state]);
            for ((after, before), stated) in after.into_iter().zip(before).zip(stated) {
                let found = (after - before) / steeper;
                assert!((found - stated).abs() < 1.0e-3, "{state}: {found} {stated}");
            }
        }
    }
}
