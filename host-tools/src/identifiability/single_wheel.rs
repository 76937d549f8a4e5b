//! One wheel whose drawbar pull, load, torque, slip and perhaps sinkage are measured.

use kapvik_firmware::terramechanics::{Soil, Wheel};
use kapvik_firmware::wheel_state::WheelNoise;
use nalgebra::{SMatrix, Vector3};

use super::beforehand::{Beforehand, by_parameters};
use super::information::{Information, SHARED, SPEED_SCALE, Slopes, covariance, unit};
use super::sensors::LastingErrors;
use crate::limit::response::respond_exactly;

/// How a wheel is measured, and what is known beforehand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelMeasurement {
    /// Noise of one instant. True slip and load are unknown but for what was measured of them.
    pub noise: WheelNoise<f64>,
    /// Whether the sinkage is measured.
    pub sinkage_seen: bool,
    /// What lasts.
    pub lasting: LastingErrors,
    /// What is known of the soil.
    pub beforehand: Beforehand,
}

/// Where a wheel rolls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Slip.
    pub slip: f64,
    /// Load, N.
    pub load_n: f64,
}

impl WheelMeasurement {
    /// What one instant at a station says; none where the soil does not carry the load.
    pub fn information(&self, wheel: &Wheel<f64>, soil: &Soil<f64>, station: &Station) -> Option<Information> {
        let Station { slip, load_n } = *station;
        let response = respond_exactly(wheel, soil, slip, load_n)?;
        let WheelNoise { drawbar_pull_n, load_n, torque_nm, slip: slip_std, sinkage_m } = self.noise;
        // A sinkage that is not seen needs some variance all the same.
        let sinkage_m = if self.sinkage_seen { sinkage_m } else { 1.0 };
        let own = Vector3::new(drawbar_pull_n, torque_nm, sinkage_m);
        let mut errors = SMatrix::<f64, 3, 5>::zeros();
        errors.fixed_view_mut::<3, 3>(0, 0).copy_from(&SMatrix::from_diagonal(&own));
        errors.set_column(3, &(response.by_slip * slip_std));
        errors.set_column(4, &(response.by_load * load_n));

        let mut slopes = Slopes::<3>::zeros();
        let by_soil = by_parameters(response.by_soil, wheel, soil);
        for (place, parameter) in self.beforehand.standardised().iter().enumerate() {
            slopes.set_column(place, &(by_soil.column(place) * parameter.scale));
        }
        let lasting = &self.lasting;
        slopes.set_column(SPEED_SCALE, &(response.by_slip * (1.0 - slip.abs()) * lasting.speed_scale));
        slopes.set_column(SHARED, &(response.by_load * lasting.load_n));
        slopes.set_column(SHARED + 1, &(unit::<3>(1) * lasting.torque_nm));
        slopes.set_column(SHARED + 2, &(unit::<3>(0) * lasting.drawbar_pull_n));
        Information::new(slopes, &covariance(&errors), if self.sinkage_seen { 3 } else { 2 })
    }
}
