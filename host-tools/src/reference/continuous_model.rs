//! The flight filters' models, seen as differential equations.

use kapvik_firmware::estimator::contact_angle::{self, ContactAngleModel};
use kapvik_firmware::estimator::hub_force::{self, HubForceModel};
use kapvik_firmware::estimator::slip_torque::{self, SlipTorqueModel};

/// A state of `N` numbers that changes with time, and `M` measurements of it.
pub trait ContinuousModel<const N: usize, const M: usize> {
    /// Rates of change of the state by itself, per second.
    fn rates(&self, state: &[f64; N]) -> [f64; N];
    /// What is measured of a state.
    fn measure(&self, state: &[f64; N]) -> [f64; M];
}

impl ContinuousModel<{ slip_torque::STATES }, { slip_torque::MEASUREMENTS }> for SlipTorqueModel<f64> {
    fn rates(&self, state: &[f64; slip_torque::STATES]) -> [f64; slip_torque::STATES] {
        SlipTorqueModel::rates(self, state)
    }
    fn measure(&self, state: &[f64; slip_torque::STATES]) -> [f64; slip_torque::MEASUREMENTS] {
        SlipTorqueModel::measure(self, state)
    }
}

impl ContinuousModel<{ contact_angle::STATES }, { contact_angle::MEASUREMENTS }> for ContactAngleModel<f64> {
    fn rates(&self, state: &[f64; contact_angle::STATES]) -> [f64; contact_angle::STATES] {
        ContactAngleModel::rates(self, state)
    }
    fn measure(&self, state: &[f64; contact_angle::STATES]) -> [f64; contact_angle::MEASUREMENTS] {
        ContactAngleModel::measure(self, state)
    }
}

/// The forces only drift.
impl ContinuousModel<{ hub_force::STATES }, { hub_force::MEASUREMENTS }> for HubForceModel<f64> {
    fn rates(&self, _: &[f64; hub_force::STATES]) -> [f64; hub_force::STATES] {
        [0.0; hub_force::STATES]
    }
    fn measure(&self, state: &[f64; hub_force::STATES]) -> [f64; hub_force::MEASUREMENTS] {
        HubForceModel::measure(self, state)
    }
}
