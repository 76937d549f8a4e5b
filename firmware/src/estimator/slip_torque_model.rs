//! How a driven wheel turns and slips, and what the sensors see of it.

use crate::scalar::Scalar;

/// States: rate ω, rad/s; resistive torque T, N·m; slip s.
pub const STATES: usize = 3;
/// Measurements: rate ω, rad/s; speed of the hub, m/s.
pub const MEASUREMENTS: usize = 2;

/// The model of one driven wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipTorqueModel<S> {
    /// Radius of the wheel, m.
    pub radius_m: S,
    /// One over the reflected inertia, 1/(kg·m²).
    pub inverse_inertia: S,
    /// Torque of the drive, the control input, N·m; none where it is unknown: then the wheel keeps its rate.
    pub motor_torque_nm: Option<S>,
}

impl<S: Scalar> SlipTorqueModel<S> {
    /// Rates of change of the state, per second.
    pub fn rates(&self, [_, torque, _]: &[S; STATES]) -> [S; STATES] {
        let driven = self.motor_torque_nm.map_or(S::zero(), |motor| motor - *torque);
        [driven * self.inverse_inertia, S::zero(), S::zero()]
    }

    /// What is measured of a state.
    pub fn measure(&self, [rate, _, slip]: &[S; STATES]) -> [S; MEASUREMENTS] {
        [*rate, self.radius_m * *rate * travel_over_rim(*slip)]
    }
}

/// Speed of the hub over that of the rim at a slip: 1 − s when driving, 1/(1 + s) when braking, not nearer to a wheel that
/// stands than slip −0.95.
pub(super) fn travel_over_rim<S: Scalar>(slip: S) -> S {
    let one = S::one();
    if slip >= S::zero() { one - slip } else { one / (one + slip.max(S::constant(-0.95))) }
}
