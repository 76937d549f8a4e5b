//! What the filters of a side say together: forces along the contacts, with the errors of force and angle.

use super::activity::BLOCKED;
use super::contact_forces::{ContactForces, ErrorOf};
use super::doubt::{INPUTS, OUTPUTS, QUANTITIES, of_wheels};
use super::drawbar_split::DrawbarSplit;
use super::estimate::{Estimate, SideEstimate, WheelActivity, WheelEstimate};
use super::hub_force;
use super::side_estimator::SideEstimator;
use super::slip_torque::SlipTorqueFilter;
use super::whole_balance::SideForces;
use crate::filter::Gaussian;
use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// How the errors of one wheel's estimates belong together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelCovariance<S> {
    /// Covariance of filter 1: resistive torque, N·m, and slip.
    pub torque_slip: [[S; 2]; 2],
    /// Covariance of filter 2: contact angle, rad, normal load and drawbar pull, N.
    pub contact: [[S; 3]; 3],
}

/// What the filters of a side state of their errors, before a network tells how far they err; it is trained with this.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Believed<S> {
    /// Of each wheel.
    pub wheels: PerAxle<WheelCovariance<S>>,
    /// Of the sum of the bogie's drawbar pulls, N².
    pub bogie_pull_variance: S,
    /// Whether its wheels roll as they will: none starts, stops or stands.
    pub is_steady: bool,
    /// The inputs of that network, where it was run in this frame.
    pub inputs: Option<[f32; INPUTS]>,
}

/// What is known of the forces on a side's hubs.
pub(super) type HubForces<S> = Gaussian<S, { hub_force::STATES }>;

impl<S: Scalar> SideEstimator<S> {
    /// What the filter of the forces says, and what these sum to.
    pub fn forces(&self) -> SideForces<'_, S> {
        let [.., rocker, bogie, body] = *self.angles.estimate().mean();
        SideForces::new(self.forces.estimate(), (rocker - body).sin_cos(), (bogie - body).sin_cos())
    }

    /// What is known of the side now, with such forces on its hubs. To be asked for once a frame, for doubt remembers.
    pub fn estimate(&mut self, forces: &HubForces<S>) -> SideEstimate {
        let contacts = self.contacts(forces);
        let mut stds = self.variances(forces, &contacts);
        if self.doubt.its_turn() {
            let inputs = self.doubt_inputs(&stds, &contacts);
            self.doubt.take(&inputs, self.speed_m_s().to_f32(), self.rims.are_heard());
        }
        let times = self.doubt.times();
        stds.iter_mut().zip(times).for_each(|(std, times): (&mut S, S)| *std = times * std.sqrt());
        let unfelt = self.unfelt_pitch_variance;
        let (quantities, _) = stds.as_chunks_mut::<QUANTITIES>();
        quantities.iter_mut().for_each(|[_, _, angle, ..]| *angle = (*angle * *angle + unfelt).sqrt());
        let [.., sum_std] = stds;
        let PerAxle { front, middle, rear } = &contacts;
        let sum = middle.pull_n + rear.pull_n;
        let half = S::constant(0.5);
        let by_load = DrawbarSplit::by_load_n(middle.load_n, rear.load_n, sum);
        let by_load = PerAxle { front: front.pull_n, middle: half * (sum + by_load), rear: half * (sum - by_load) };
        let bogie_drawbar_pull_n = published(sum, sum_std);
        let filters = self.wheels.as_ref().zip(self.activity);
        let wheels = contacts
            .as_ref()
            .zip(by_load)
            .zip(filters.zip(of_wheels(&stds).zip(of_wheels(&times))))
            .zip(self.lifted)
            .map(|(((contact, by_load), ((filter, activity), (stds, times))), lifted)| {
                let wheel = WheelEstimate {
                    drawbar_pull_by_load_n: by_load.to_f32(),
                    ..wheel(stds, times, contact, filter, activity)
                };
                if lifted { in_the_air(&wheel) } else { wheel }
            });
        let mut side = SideEstimate { wheels, bogie_drawbar_pull_n };
        match (self.lifted.middle, self.lifted.rear) {
            (true, false) => alone_on_the_ground(&mut side.wheels.rear, &bogie_drawbar_pull_n),
            (false, true) => alone_on_the_ground(&mut side.wheels.middle, &bogie_drawbar_pull_n),
            (true, true) => side.bogie_drawbar_pull_n = side.wheels.rear.drawbar_pull_n,
            (false, false) => {}
        }
        side
    }

    /// How the errors of each wheel's estimates belong together, with such forces on the hubs.
    pub fn covariances(&self, forces: &HubForces<S>) -> PerAxle<WheelCovariance<S>> {
        let wheels = self.stated(forces, &self.contacts(forces));
        wheels.zip(of_wheels(&self.doubt.times())).map(|(covariance, doubt)| {
            let mut covariance = covariance.times(doubt);
            let [[of_angle, ..], ..] = &mut covariance.contact;
            *of_angle += self.unfelt_pitch_variance;
            covariance
        })
    }

    /// What the filters would have believed, with such forces on the hubs.
    pub fn believed(&self, forces: &HubForces<S>) -> Believed<S> {
        let contacts = self.contacts(forces);
        let variances = self.variances(forces, &contacts);
        let inputs = self.doubt.its_turn().then(|| self.doubt_inputs(&variances, &contacts));
        let [.., bogie_pull_variance] = variances;
        Believed { wheels: self.stated(forces, &contacts), bogie_pull_variance, is_steady: self.is_steady(), inputs }
    }

    /// Covariances as the filters state them, with such forces on the hubs.
    fn stated(&self, forces: &HubForces<S>, contacts: &PerAxle<ContactForces<S>>) -> PerAxle<WheelCovariance<S>> {
        let entry =
            |filter: &SlipTorqueFilter<S>, one, other| filter.estimate().covariance(one, other).unwrap_or(S::zero());
        contacts.as_ref().zip(self.wheels.as_ref()).map(|(contact, filter)| WheelCovariance {
            torque_slip: [[entry(filter, 1, 1), entry(filter, 1, 2)], [entry(filter, 2, 1), entry(filter, 2, 2)]],
            contact: contact.errors.map(|one| contact.errors.map(|other| self.covariance(forces, &one, &other))),
        })
    }

    /// Variances as the filters state them, with such forces on the hubs: in the order of the outputs of the network that tells how true
    /// they are.
    fn variances(&self, forces: &HubForces<S>, contacts: &PerAxle<ContactForces<S>>) -> [S; OUTPUTS] {
        let ([.., middle], [.., rear]) = (&contacts.middle.errors, &contacts.rear.errors);
        // It does not hang on their split but for the contacts' difference.
        let sum = ErrorOf {
            by_angles: sums(&middle.by_angles, &rear.by_angles),
            left: middle.left,
            by_forces: sums(&middle.by_forces, &rear.by_forces),
            by_split: middle.by_split + rear.by_split,
        };
        let mut variances = [self.variance(forces, &sum); OUTPUTS];
        let (of_wheels, _) = variances.as_chunks_mut::<QUANTITIES>();
        let [_, front, middle, rear, ..] = self.angles.estimate().variances();
        let paths = PerAxle { front, middle, rear };
        let wheels = contacts.as_ref().zip(self.wheels.as_ref()).zip(paths).into_array();
        for ([torque, slip, angle, load, pull], ((contact, filter), path)) in of_wheels.iter_mut().zip(wheels) {
            [_, *torque, *slip] = filter.estimate().variances();
            let [of_angle, of_load, of_pull] = &contact.errors;
            // The same as of the others, of the one angle that it hangs on.
            let by_angle = of_angle.left * path + self.beside_paths();
            *angle = by_angle + forces.variance_of_sum(&of_angle.by_forces);
            (*load, *pull) = (self.variance(forces, of_load), self.variance(forces, of_pull));
        }
        variances
    }

    /// By what variance each contact angle errs beside what its filter states, rad².
    fn beside_paths(&self) -> S {
        self.digging_in.terrain().beside_paths() + self.angles.joints().unrisen_variance()
    }

    /// Variance of an error. While wheels dig in, each contact angle errs by itself, too.
    #[inline(never)] // flash is scarcer than the time of a call
    fn variance(&self, forces: &HubForces<S>, of: &ErrorOf<S>) -> S {
        let mut by_angles = of.left * self.angles.estimate().variance_of_sum(&of.by_angles);
        let beside_paths = self.beside_paths();
        if beside_paths > S::zero() {
            let [_, front, middle, rear, ..] = of.by_angles;
            by_angles += beside_paths * (front * front + middle * middle + rear * rear);
        }
        by_angles + forces.variance_of_sum(&of.by_forces) + of.by_split * of.by_split
    }

    /// The same of two errors together.
    fn covariance(&self, forces: &HubForces<S>, one: &ErrorOf<S>, other: &ErrorOf<S>) -> S {
        let [_, front, middle, rear, ..] = one.by_angles;
        let [_, other_front, other_middle, other_rear, ..] = other.by_angles;
        let by_themselves = front * other_front + middle * other_middle + rear * other_rear;
        let by_angles = one.left.min(other.left)
            * self.angles.estimate().covariance_of_sums(&one.by_angles, &other.by_angles)
            + self.beside_paths() * by_themselves;
        by_angles + forces.covariance_of_sums(&one.by_forces, &other.by_forces) + one.by_split * other.by_split
    }
}

impl<S: Scalar> WheelCovariance<S> {
    /// With so many times the standard deviations.
    fn times(&self, [torque, slip, angle, load, pull]: [S; QUANTITIES]) -> Self {
        Self {
            torque_slip: scaled(&self.torque_slip, [torque, slip]),
            contact: scaled(&self.contact, [angle, load, pull]),
        }
    }
}

fn scaled<S: Scalar, const N: usize>(covariance: &[[S; N]; N], times: [S; N]) -> [[S; N]; N] {
    let mut scaled = *covariance;
    for (line, of_line) in scaled.iter_mut().zip(times) {
        line.iter_mut().zip(times).for_each(|(entry, of_column)| *entry = of_line * of_column * *entry);
    }
    scaled
}

fn wheel<S: Scalar>(
    [torque_std, slip_std, angle_std, load_std, pull_std]: [S; QUANTITIES],
    [_, times_slip, .., times_pull]: [S; QUANTITIES],
    contact: &ContactForces<S>,
    filter: &SlipTorqueFilter<S>,
    activity: WheelActivity,
) -> WheelEstimate {
    let [_, torque, slip] = *filter.estimate().mean();
    let [.., pull] = &contact.errors;
    WheelEstimate {
        activity,
        slip: published_slip(slip, slip_std, activity),
        shared_slip_std: (times_slip * filter.shared_slip_variance().sqrt()).to_f32(),
        resistive_torque_nm: published(torque, torque_std),
        contact_angle_rad: published(contact.contact_angle_rad, angle_std),
        normal_load_n: published(contact.load_n, load_std),
        drawbar_pull_n: published(contact.pull_n, pull_std),
        split_std_n: (times_pull * pull.by_split.abs()).to_f32(),
        drawbar_pull_by_load_n: contact.pull_n.to_f32(),
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

/// Of a bogie whose other wheel is in the air a wheel pulls all.
fn alone_on_the_ground(wheel: &mut WheelEstimate, bogie_drawbar_pull_n: &Estimate) {
    wheel.drawbar_pull_n = *bogie_drawbar_pull_n;
    wheel.drawbar_pull_by_load_n = bogie_drawbar_pull_n.value;
    wheel.split_std_n = 0.0;
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
