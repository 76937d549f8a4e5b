//! What the filters of a side say together: forces along the contacts, with the errors of force and angle.

use super::compaction::Correction;
use super::contact_angle;
use super::doubt::{Doubt, WheelDoubt};
use super::drawbar_split::{DrawbarSplit, OF_TORQUE, along_contact};
use super::estimate::{Estimate, SideEstimate, WheelActivity, WheelEstimate};
use super::hub_force;
use super::side_estimator::{BLOCKED, SideEstimator};
use super::slip_torque::SlipTorqueFilter;
use super::whole_balance::SideForces;
use crate::filter::Gaussian;
use crate::rover::{Axle, PerAxle, Planar};
use crate::scalar::Scalar;

/// How the errors of one wheel's estimates belong together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelCovariance<S> {
    /// Covariance of filter 1: resistive torque, N·m, and slip.
    pub torque_slip: [[S; 2]; 2],
    /// Covariance of filter 2: contact angle, rad, normal load and drawbar pull, N.
    pub contact: [[S; 3]; 3],
}

/// What of the lag of a contact angle the pull feels: the force along the link lags too, the other way.
const LAG_IN_FORCES: f64 = 0.7;
/// What of the stated standard deviation of a force along a link is true. That force comes from moments, of which the drives' noise
/// is the greater part; it is white, and the filter takes some of it for drift.
const ALONG_LINK: f64 = 0.85;

/// What is known of the forces on a side's hubs.
type HubForces<S> = Gaussian<S, { hub_force::STATES }>;

/// Forces along one contact, and how they hang on the states of filter 2.
struct ContactForces<S> {
    contact_angle_rad: S,
    /// What the filter states of it, rad².
    angle_variance: S,
    load_n: S,
    pull_n: S,
    /// Sine and cosine of the contact angle less the pitch of the link.
    angle: (S, S),
    /// Which state of the contact-angle filter the contact angle is.
    state: usize,
    /// Load and pull by the states of the contact-angle filter.
    by_angles: [[S; contact_angle::STATES]; 2],
    /// The same by the states of the hub-force filter.
    by_forces: [[S; hub_force::STATES]; 2],
    /// What the torques tell of the contact angle.
    correction: Correction<S>,
    /// The same by the split between the wheels of a bogie: one standard deviation, N.
    by_split: [S; 2],
    /// The same by what the contact angle lags behind.
    by_lag: [S; 2],
}

impl<S: Scalar> SideEstimator<S> {
    /// What the filter of the forces says, and what these sum to.
    pub fn forces(&self) -> SideForces<'_, S> {
        let [.., rocker, bogie, body] = *self.angles.estimate().mean();
        SideForces::new(self.forces.estimate(), (rocker - body).sin_cos(), (bogie - body).sin_cos())
    }

    /// What is known of the side now, with such forces on its hubs.
    pub fn estimate(&self, forces: &HubForces<S>) -> SideEstimate {
        let doubt = self.doubt();
        let PerAxle { front, middle, rear } = self.contacts(forces);
        let sum = middle.pull_n + rear.pull_n;
        let half = S::constant(0.5);
        let by_load = DrawbarSplit::by_load_n(middle.load_n, rear.load_n, sum);
        let by_load = PerAxle { front: front.pull_n, middle: half * (sum + by_load), rear: half * (sum - by_load) };
        let bogie_drawbar_pull_n = self.sum_of_pulls(forces, &doubt, &middle, &rear);
        let contacts = PerAxle { front, middle, rear };
        let filters = self.wheels.as_ref().zip(self.activity);
        let wheels = contacts.zip(by_load).zip(filters.zip(doubt.wheels)).zip(self.lifted()).map(
            |(((contact, by_load), ((filter, activity), of_wheel)), lifted)| {
                let wheel = WheelEstimate {
                    drawbar_pull_by_load_n: by_load.to_f32(),
                    ..self.wheel(forces, &of_wheel, &contact, filter, activity)
                };
                if lifted { in_the_air(&wheel) } else { wheel }
            },
        );
        SideEstimate { wheels, bogie_drawbar_pull_n }
    }

    /// How the errors of each wheel's estimates belong together, with such forces on the hubs.
    pub fn covariances(&self, forces: &HubForces<S>) -> PerAxle<WheelCovariance<S>> {
        let entry =
            |filter: &SlipTorqueFilter<S>, one, other| filter.estimate().covariance(one, other).unwrap_or(S::zero());
        let doubt = self.doubt();
        self.contacts(forces).zip(self.wheels.as_ref()).zip(doubt.wheels).map(|((contact, filter), of_wheel)| {
            let (slip, torque) = (of_wheel.slip, of_wheel.torque);
            let both = (torque * slip).sqrt();
            WheelCovariance {
                torque_slip: [
                    [torque * entry(filter, 1, 1) + of_wheel.torque_variance, both * entry(filter, 1, 2)],
                    [both * entry(filter, 2, 1), slip * entry(filter, 2, 2)],
                ],
                contact: self.covariance(forces, &of_wheel, &contact),
            }
        })
    }

    fn wheel(
        &self,
        forces: &HubForces<S>,
        of_wheel: &WheelDoubt<S>,
        contact: &ContactForces<S>,
        filter: &SlipTorqueFilter<S>,
        activity: WheelActivity,
    ) -> WheelEstimate {
        let [angle_std, load_std, pull_std] = self.variances(forces, of_wheel, contact).map(S::sqrt);
        let [_, torque, slip] = *filter.estimate().mean();
        let [_, torque_variance, slip_variance] = filter.estimate().variances();
        let torque_std = (of_wheel.torque * torque_variance + of_wheel.torque_variance).sqrt();
        let slip_std = (of_wheel.slip * slip_variance).sqrt();
        let normal_load_n = published(contact.load_n, load_std);
        let [_, split_std] = contact.by_split;
        WheelEstimate {
            activity,
            slip: published_slip(slip, slip_std, activity),
            shared_slip_std: filter.shared_slip_variance().sqrt().to_f32(),
            resistive_torque_nm: published(torque, torque_std),
            contact_angle_rad: published(contact.contact_angle_rad, angle_std),
            normal_load_n,
            drawbar_pull_n: published(contact.pull_n, pull_std),
            split_std_n: split_std.abs().to_f32(),
            drawbar_pull_by_load_n: contact.pull_n.to_f32(),
        }
    }

    /// The contacts, with the split of the bogie's pull that the torques tell now, and with what these tell of the contact angles.
    fn contacts(&self, estimate: &HubForces<S>) -> PerAxle<ContactForces<S>> {
        let [_, front, middle, rear, rocker_pitch, bogie_pitch, _] = *self.angles.estimate().mean();
        let told_by_links = self.digging_in.told_by_links();
        let [_, of_front, of_middle, of_rear, ..] = self.angles.estimate().variances();
        let contact = |path: S, correction: Correction<S>, variance: S, link: S| {
            let path = path + correction.steeper;
            (path + told_by_links * (link - path), variance, correction)
        };
        let corrections = &self.corrections;
        let (front, middle, rear) = (
            contact(front, corrections.front, of_front, rocker_pitch),
            contact(middle, corrections.middle, of_middle, bogie_pitch),
            contact(rear, corrections.rear, of_rear, bogie_pitch),
        );
        let forces = self.forces.forces_at(estimate);
        let PerAxle { middle: middle_hub, rear: rear_hub, .. } = self.on_ground(&forces, corrections);
        let sum = middle_hub.drawbar_pull_n + rear_hub.drawbar_pull_n;
        let form = DrawbarSplit::by_torque(&middle_hub.wheel, &rear_hub.wheel, sum).std_n;
        let torque_variance = |filter: &SlipTorqueFilter<S>| {
            let [_, torque, _] = filter.estimate().variances();
            torque
        };
        let per_torque = S::constant(OF_TORQUE) / self.rover.wheel.radius_m;
        let of_torques = torque_variance(&self.wheels.middle) + torque_variance(&self.wheels.rear);
        let split = S::constant(0.5) * (form * form + per_torque * per_torque * of_torques).sqrt();
        let mut middle = contact_forces(Axle::Middle, middle, bogie_pitch, forces.middle, split);
        let mut rear = contact_forces(Axle::Rear, rear, bogie_pitch, forces.rear, -split);
        share_along_bogie(&mut middle, &mut rear);
        PerAxle { front: contact_forces(Axle::Front, front, rocker_pitch, forces.front, S::zero()), middle, rear }
    }

    fn variances(&self, forces: &HubForces<S>, of_wheel: &WheelDoubt<S>, contact: &ContactForces<S>) -> [S; 3] {
        let Correction { left_of_angle, left_of_pull, .. } = contact.correction;
        // As far as the torque tells the angle, it tells the pull as well, whatever the force along the link is taken for.
        let left = [(left_of_angle, S::one()), (left_of_pull, left_of_pull * left_of_pull)];
        let rows = contact.by_angles.iter().zip(&contact.by_forces).zip(contact.by_split.iter().zip(&contact.by_lag));
        let mut variances = [of_wheel.load_variance, S::zero()];
        for ((variance, left), ((by_angles, by_forces), (split, lag))) in variances.iter_mut().zip(left).zip(rows) {
            let by_angles = of_wheel.angle * self.angles.estimate().weighted_sum(by_angles).1
                + of_wheel.angle_variance * *lag * *lag;
            let by_forces = of_wheel.force * forces.weighted_sum(by_forces).1;
            *variance += left.0 * by_angles + left.1 * by_forces + *split * *split;
        }
        let [load, pull] = variances;
        [left_of_angle * (of_wheel.angle * contact.angle_variance + of_wheel.angle_variance), load, pull]
    }

    fn covariance(&self, estimate: &HubForces<S>, of_wheel: &WheelDoubt<S>, contact: &ContactForces<S>) -> [[S; 3]; 3] {
        let (zero, one) = (S::zero(), S::one());
        let ([load_angles, pull_angles], [load_forces, pull_forces]) = (&contact.by_angles, &contact.by_forces);
        let ([load_split, pull_split], [load_lag, pull_lag]) = (contact.by_split, contact.by_lag);
        let mut by_itself = [zero; contact_angle::STATES];
        by_itself.iter_mut().skip(contact.state).take(1).for_each(|entry| *entry = one);
        let Correction { left_of_angle, left_of_pull, by_pull, .. } = contact.correction;
        // Where the force along the link is too large, an angle that the torque tells comes out too small, and the pull not as much too large.
        let angle_forces = pull_forces.map(|entry| -by_pull * entry);
        let pull_forces = pull_forces.map(|entry| left_of_pull * entry);
        let rows = [
            (&by_itself, &angle_forces, zero, one, left_of_angle),
            (load_angles, load_forces, load_split, load_lag, left_of_angle),
            (pull_angles, &pull_forces, pull_split, pull_lag, left_of_pull),
        ];
        let mut covariance = [[S::zero(); 3]; 3];
        for (line, (angles, forces, split, lag, left)) in covariance.iter_mut().zip(rows) {
            for (place, (other_angles, other_forces, other_split, other_lag, other_left)) in line.iter_mut().zip(rows) {
                let by_angles = of_wheel.angle * self.angles.estimate().covariance_of_sums(angles, other_angles)
                    + of_wheel.angle_variance * lag * other_lag;
                *place = left.min(other_left) * by_angles
                    + of_wheel.force * estimate.covariance_of_sums(forces, other_forces)
                    + split * other_split;
            }
        }
        let [_, [_, of_load, _], _] = &mut covariance;
        *of_load += of_wheel.load_variance;
        covariance
    }

    /// The sum of a bogie's drawbar pulls, which does not hang on their split but for the contacts' difference.
    fn sum_of_pulls(
        &self,
        forces: &HubForces<S>,
        doubt: &Doubt<S>,
        middle: &ContactForces<S>,
        rear: &ContactForces<S>,
    ) -> Estimate {
        let ([_, middle_angles], [_, rear_angles]) = (&middle.by_angles, &rear.by_angles);
        let ([_, middle_forces], [_, rear_forces]) = (&middle.by_forces, &rear.by_forces);
        let ([_, middle_split], [_, rear_split]) = (middle.by_split, rear.by_split);
        let by_angles = self.angles.estimate().weighted_sum(&sums(middle_angles, rear_angles)).1;
        let by_forces = forces.weighted_sum(&sums(middle_forces, rear_forces)).1;
        let split = middle_split + rear_split;
        let lag = |doubt: &WheelDoubt<S>, [_, pull]: [S; 2]| doubt.angle_variance * pull * pull;
        // Each wheel feels half of its own lag and of the other's; both together feel all of both.
        let lags = S::constant(2.0) * (lag(&doubt.wheels.middle, middle.by_lag) + lag(&doubt.wheels.rear, rear.by_lag));
        let left = middle.correction.left_of_pull;
        let variance = left * (doubt.wheels.middle.angle * by_angles + lags)
            + left * left * doubt.wheels.middle.force * by_forces
            + split * split;
        published(middle.pull_n + rear.pull_n, variance.sqrt())
    }
}

/// What is known of a wheel in the air: nothing pushes it, as surely as its cell says that nothing carries it.
fn in_the_air(wheel: &WheelEstimate) -> WheelEstimate {
    let none = Estimate { value: 0.0, std: wheel.normal_load_n.std };
    WheelEstimate {
        activity: WheelActivity::Lifted,
        normal_load_n: none,
        drawbar_pull_n: none,
        split_std_n: 0.0,
        drawbar_pull_by_load_n: 0.0,
        ..*wheel
    }
}

/// Forces along a contact of a hub, known with a variance, with the force on it in the coordinates of its link at a pitch.
fn contact_forces<S: Scalar>(
    axle: Axle,
    (contact, angle_variance, correction): (S, S, Correction<S>),
    pitch: S,
    force: Planar<S>,
    split: S,
) -> ContactForces<S> {
    let (zero, one, half) = (S::zero(), S::one(), S::constant(0.5));
    let (sine, cosine) = (contact - pitch).sin_cos();
    let (load_n, pull_n) = along_contact(force, (sine, cosine));
    let felt = S::constant(LAG_IN_FORCES);
    // A contact that is steeper by dγ sees W + DP dγ·(−1) as load and DP + W dγ as pull.
    let (state, against_link) = match axle {
        Axle::Front => (1, [zero, one, zero, zero, -one, zero, zero]),
        Axle::Middle => (2, [zero, zero, one, zero, zero, -one, zero]),
        Axle::Rear => (3, [zero, zero, zero, one, zero, -one, zero]),
    };
    let known = S::constant(ALONG_LINK);
    let by_hub = |across: S, along: S| match axle {
        Axle::Front => [across, zero, zero, known * along, zero],
        Axle::Middle => [zero, across, zero, zero, known * half * along],
        Axle::Rear => [zero, zero, across, zero, known * half * along],
    };
    ContactForces {
        contact_angle_rad: contact,
        angle_variance,
        load_n,
        pull_n,
        angle: (sine, cosine),
        state,
        by_angles: [against_link.map(|entry| -pull_n * entry), against_link.map(|entry| load_n * entry)],
        by_forces: [by_hub(cosine, -sine), by_hub(sine, cosine)],
        correction,
        by_split: [-sine * split, cosine * split],
        by_lag: [-felt * pull_n, felt * load_n],
    }
}

/// What the contact angles of a bogie's wheels do to their forces. The moments hold the sum of the forces along the bogie, the torques the
/// difference of the drawbar pulls: where one contact is steeper by dγ, its pull seems W dγ larger, and the forces along the bogie have
/// to change by opposite amounts until both pulls are larger by about half of that.
fn share_along_bogie<S: Scalar>(middle: &mut ContactForces<S>, rear: &mut ContactForces<S>) {
    let zero = S::zero();
    let row = |middle: S, rear: S| [zero, zero, middle, rear, zero, -(middle + rear), zero];
    let ((middle_sine, middle_cosine), (rear_sine, rear_cosine)) = (middle.angle, rear.angle);
    let both = middle_cosine + rear_cosine;
    let (by_middle, by_rear) = (middle.load_n / both, rear.load_n / both);
    let pull = row(by_middle * rear_cosine, by_rear * middle_cosine);
    let felt = S::constant(LAG_IN_FORCES);
    // Half of its own lag and half of the other's, which know nothing of each other: together 1/√2 of one.
    let of_both = S::constant(core::f64::consts::FRAC_1_SQRT_2);
    let of_middle = row(by_middle * middle_sine - middle.pull_n, -by_rear * middle_sine);
    let of_rear = row(-by_middle * rear_sine, by_rear * rear_sine - rear.pull_n);
    for (wheel, load) in [(middle, of_middle), (rear, of_rear)] {
        wheel.by_angles = [load, pull];
        let (sine, _) = wheel.angle;
        wheel.by_lag = [felt * (of_both * sine * wheel.load_n - wheel.pull_n), of_both * felt * wheel.load_n];
    }
}

fn sums<S: Scalar, const N: usize>(one: &[S; N], other: &[S; N]) -> [S; N] {
    let mut sums = *one;
    sums.iter_mut().zip(other).for_each(|(sum, entry)| *sum += *entry);
    sums
}

fn published<S: Scalar>(value: S, std: S) -> Estimate {
    Estimate { value: value.to_f32(), std: std.to_f32() }
}

fn published_slip<S: Scalar>(slip: S, std: S, activity: WheelActivity) -> Option<Estimate> {
    match activity {
        WheelActivity::Standing => None,
        WheelActivity::Blocked => Some(Estimate { value: -1.0, std: BLOCKED as f32 }),
        _ => Some(published(slip.max(-S::one()).min(S::one()), std)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Correction, along_contact, contact_forces, share_along_bogie};
    use crate::rover::{Axle, Planar};

    /// Cells and the sum along the bogie are held, and the difference of the pulls: where a contact is taken to be steeper, the force along
    /// the bogie shifts between its wheels until that is so again. Loads and pulls must change by what is stated of them.
    #[test]
    fn a_steeper_contact_changes_the_forces_on_both_wheels_of_a_bogie() {
        let (cells, along, angles, steeper) = ([70.0, 50.0], [9.0, -3.0], [0.4, -0.2], 1.0e-6);
        let forces = |angles: [f64; 2], shifted: f64| {
            let of = |cell, along, angle: f64| along_contact(Planar { x: along, z: cell }, angle.sin_cos());
            let [(load, pull), (other_load, other_pull)] =
                [of(cells[0], along[0] + shifted, angles[0]), of(cells[1], along[1] - shifted, angles[1])];
            [load, pull, other_load, other_pull]
        };
        let contact = |axle, at: usize| {
            contact_forces(
                axle,
                (angles[at], 1.0e-4, Correction::none()),
                0.0,
                Planar { x: along[at], z: cells[at] },
                0.0,
            )
        };
        let (mut middle, mut rear) = (contact(Axle::Middle, 0), contact(Axle::Rear, 1));
        share_along_bogie(&mut middle, &mut rear);
        let before = forces(angles, 0.0);
        for (state, angles) in [(2, [angles[0] + steeper, angles[1]]), (3, [angles[0], angles[1] + steeper])] {
            let off = |shifted: f64| {
                let [_, pull, _, other_pull] = forces(angles, shifted);
                pull - other_pull - (before[1] - before[3])
            };
            // The difference is linear in what is shifted.
            let shifted = -off(0.0) / (off(1.0) - off(0.0));
            let after = forces(angles, shifted);
            let stated =
                [middle.by_angles[0], middle.by_angles[1], rear.by_angles[0], rear.by_angles[1]].map(|row| row[state]);
            for ((after, before), stated) in after.into_iter().zip(before).zip(stated) {
                let found = (after - before) / steeper;
                assert!((found - stated).abs() < 1.0e-3, "{state}: {found} {stated}");
            }
        }
    }
}
