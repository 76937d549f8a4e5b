//! What the filters of a side say together: forces along the contacts, with the errors of force and angle.

use super::contact_angle;
use super::doubt::{AnglesKnown, Doubt, WheelDoubt};
use super::drawbar_split::{DrawbarSplit, along_contact};
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
    load_n: S,
    pull_n: S,
    /// Contact angle, load and pull by the states of the contact-angle filter.
    by_angles: [[S; contact_angle::STATES]; 3],
    /// The same by the states of the hub-force filter.
    by_forces: [[S; hub_force::STATES]; 3],
    /// The same by the split between the wheels of a bogie: one standard deviation, N.
    by_split: [S; 3],
    /// The same by what the contact angle lags behind.
    by_lag: [S; 3],
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
                    ..self.wheel(forces, (&doubt, &of_wheel), &contact, filter, activity)
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
        let Doubt { torque, slip, .. } = doubt;
        let both = (torque * slip).sqrt();
        self.contacts(forces).zip(self.wheels.as_ref()).zip(doubt.wheels).map(|((contact, filter), of_wheel)| {
            WheelCovariance {
                torque_slip: [
                    [torque * entry(filter, 1, 1) + of_wheel.torque_variance, both * entry(filter, 1, 2)],
                    [both * entry(filter, 2, 1), slip * entry(filter, 2, 2)],
                ],
                contact: self.covariance(forces, (&doubt, &of_wheel), &contact),
            }
        })
    }

    fn wheel(
        &self,
        forces: &HubForces<S>,
        doubt: (&Doubt<S>, &WheelDoubt<S>),
        contact: &ContactForces<S>,
        filter: &SlipTorqueFilter<S>,
        activity: WheelActivity,
    ) -> WheelEstimate {
        let [angle_std, load_std, pull_std] = self.variances(forces, doubt, contact).map(S::sqrt);
        let (doubt, of_wheel) = doubt;
        let [_, torque, slip] = *filter.estimate().mean();
        let [_, torque_variance, slip_variance] = filter.estimate().variances();
        let torque_std = (doubt.torque * torque_variance + of_wheel.torque_variance).sqrt();
        let slip_std = (doubt.slip * slip_variance).sqrt();
        let normal_load_n = published(contact.load_n, load_std);
        let [_, _, split_std] = contact.by_split;
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

    /// The contacts, with the split of the bogie's pull that the torques tell now.
    fn contacts(&self, estimate: &HubForces<S>) -> PerAxle<ContactForces<S>> {
        let [_, front, middle, rear, rocker_pitch, bogie_pitch, _] = *self.angles.estimate().mean();
        let told_by_links = self.told_by_links;
        let contact = |path: S, link: S| path + told_by_links * (link - path);
        let forces = self.forces.forces_at(estimate);
        let (middle_hub, rear_hub) = self.bogie_wheels(bogie_pitch, &forces);
        let sum = middle_hub.drawbar_pull_n + rear_hub.drawbar_pull_n;
        let split = S::constant(0.5) * DrawbarSplit::by_torque(&middle_hub.wheel, &rear_hub.wheel, sum).std_n;
        PerAxle {
            front: contact_forces(Axle::Front, contact(front, rocker_pitch), rocker_pitch, forces.front, S::zero()),
            middle: contact_forces(Axle::Middle, contact(middle, bogie_pitch), bogie_pitch, forces.middle, split),
            rear: contact_forces(Axle::Rear, contact(rear, bogie_pitch), bogie_pitch, forces.rear, -split),
        }
    }

    fn doubt(&self) -> Doubt<S> {
        let known = AnglesKnown { still: self.angles.still(), told_by_links: self.told_by_links };
        Doubt::of(self.angles.runs(), self.forces.runs(), self.angles.trends(), &known)
    }

    fn variances(
        &self,
        forces: &HubForces<S>,
        (doubt, of_wheel): (&Doubt<S>, &WheelDoubt<S>),
        contact: &ContactForces<S>,
    ) -> [S; 3] {
        let mut variances = [S::zero(), of_wheel.load_variance, S::zero()];
        let rows = contact.by_angles.iter().zip(&contact.by_forces).zip(contact.by_split.iter().zip(&contact.by_lag));
        for (variance, ((by_angles, by_forces), (split, lag))) in variances.iter_mut().zip(rows) {
            *variance += of_wheel.angle * self.angles.estimate().weighted_sum(by_angles).1
                + doubt.force * forces.weighted_sum(by_forces).1
                + *split * *split
                + of_wheel.angle_variance * *lag * *lag;
        }
        variances
    }

    fn covariance(
        &self,
        estimate: &HubForces<S>,
        (doubt, of_wheel): (&Doubt<S>, &WheelDoubt<S>),
        contact: &ContactForces<S>,
    ) -> [[S; 3]; 3] {
        let rows =
            || contact.by_angles.iter().zip(&contact.by_forces).zip(contact.by_split.iter().zip(&contact.by_lag));
        let mut covariance = [[S::zero(); 3]; 3];
        for (line, ((angles, forces), (split, lag))) in covariance.iter_mut().zip(rows()) {
            for (place, ((other_angles, other_forces), (other_split, other_lag))) in line.iter_mut().zip(rows()) {
                *place = of_wheel.angle * self.angles.estimate().covariance_of_sums(angles, other_angles)
                    + doubt.force * estimate.covariance_of_sums(forces, other_forces)
                    + *split * *other_split
                    + of_wheel.angle_variance * *lag * *other_lag;
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
        let ([.., middle_angles], [.., rear_angles]) = (&middle.by_angles, &rear.by_angles);
        let ([.., middle_forces], [.., rear_forces]) = (&middle.by_forces, &rear.by_forces);
        let ([.., middle_split], [.., rear_split]) = (middle.by_split, rear.by_split);
        let by_angles = self.angles.estimate().weighted_sum(&sums(middle_angles, rear_angles)).1;
        let by_forces = forces.weighted_sum(&sums(middle_forces, rear_forces)).1;
        let split = middle_split + rear_split;
        let lag = |doubt: &WheelDoubt<S>, [.., pull]: [S; 3]| doubt.angle_variance * pull * pull;
        let lags = lag(&doubt.wheels.middle, middle.by_lag) + lag(&doubt.wheels.rear, rear.by_lag);
        let variance = doubt.wheels.middle.angle * by_angles + doubt.force * by_forces + split * split + lags;
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

/// Forces along a contact of a hub, with the force on it in the coordinates of its link at a pitch.
fn contact_forces<S: Scalar>(axle: Axle, contact: S, pitch: S, force: Planar<S>, split: S) -> ContactForces<S> {
    let (zero, one, half) = (S::zero(), S::one(), S::constant(0.5));
    let (sine, cosine) = (contact - pitch).sin_cos();
    let (load_n, pull_n) = along_contact(force, (sine, cosine));
    let felt = S::constant(LAG_IN_FORCES);
    // A contact that is steeper by dγ sees W + DP dγ·(−1) as load and DP + W dγ as pull.
    let (angle, against_link) = match axle {
        Axle::Front => ([zero, one, zero, zero, zero, zero, zero], [zero, one, zero, zero, -one, zero, zero]),
        Axle::Middle => ([zero, zero, one, zero, zero, zero, zero], [zero, zero, one, zero, zero, -one, zero]),
        Axle::Rear => ([zero, zero, zero, one, zero, zero, zero], [zero, zero, zero, one, zero, -one, zero]),
    };
    let known = S::constant(ALONG_LINK);
    let by_hub = |across: S, along: S| match axle {
        Axle::Front => [across, zero, zero, known * along, zero],
        Axle::Middle => [zero, across, zero, zero, known * half * along],
        Axle::Rear => [zero, zero, across, zero, known * half * along],
    };
    ContactForces {
        contact_angle_rad: contact,
        load_n,
        pull_n,
        by_angles: [angle, against_link.map(|entry| -pull_n * entry), against_link.map(|entry| load_n * entry)],
        by_forces: [by_hub(zero, zero), by_hub(cosine, -sine), by_hub(sine, cosine)],
        by_split: [zero, -sine * split, cosine * split],
        by_lag: [one, -felt * pull_n, felt * load_n],
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
