//! Which sensors said what the filters did not expect.

use super::{contact_angle, hub_force, slip_torque};
use crate::filter::{Fate, Innovation};
use crate::rover::PerAxle;

/// Surprises of one wheel.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct WheelSurprises {
    /// By the encoder.
    pub wheel_rate: bool,
    /// By the velocimeter, as the hub's speed.
    pub hub_speed: bool,
    /// By the drive's torque.
    pub motor_torque: bool,
    /// By the load cell.
    pub load_cell: bool,
}

/// Surprises of one side.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Surprises {
    /// By the velocimeter forward.
    pub velocity_x: bool,
    /// By the velocimeter upward.
    pub velocity_z: bool,
    /// By the rocker's angle.
    pub rocker_angle: bool,
    /// By the bogie's angle.
    pub bogie_angle: bool,
    /// By the wheels' own sensors.
    pub wheels: PerAxle<WheelSurprises>,
}

impl WheelSurprises {
    /// Takes what filter 1 was told.
    pub fn of_wheel<S>(&mut self, told: &Innovation<S, { slip_torque::MEASUREMENTS }>) {
        let [wheel_rate, hub_speed] = told.residuals.each_ref().map(|residual| residual.fate == Fate::Rejected);
        (self.wheel_rate, self.hub_speed) = (wheel_rate, hub_speed);
    }
}

impl Surprises {
    /// Takes what the first half of filter 2 was told.
    pub fn of_side<S>(&mut self, told: &Innovation<S, { contact_angle::MEASUREMENTS }>) {
        let [x, z, rocker, bogie, _] = told.residuals.each_ref().map(|residual| residual.fate == Fate::Rejected);
        (self.velocity_x, self.velocity_z, self.rocker_angle, self.bogie_angle) = (x, z, rocker, bogie);
    }

    /// Takes what the second half of filter 2 was told. A moment is no sensor's own; the cells are.
    pub fn of_cells<S>(&mut self, told: &Innovation<S, { hub_force::MEASUREMENTS }>) {
        let [front, middle, rear, _, _] = told.residuals.each_ref().map(|residual| residual.fate == Fate::Rejected);
        self.wheels.front.load_cell = front;
        self.wheels.middle.load_cell = middle;
        self.wheels.rear.load_cell = rear;
    }
}
