//! One side of a rover: what its load cells, drives and velocimeter say, and what its balances add.
//!
//! No sensor sees a drawbar pull. It follows from the balances, which hold whatever the soil is: of the middle and the rear
//! wheel together from the bogie's, of the front wheel from the rest. So the channels are what the soil predicts of the
//! torques, less what the drives say, and what is left over of the balances where the soil's forces are put in at the
//! measured slips and loads; and the sinkages, where something measures them.

use kapvik_firmware::rover::Rover;
use kapvik_firmware::terramechanics::Soil;
use nalgebra::{SMatrix, SVector};
use serde::Serialize;

use super::beforehand::{Beforehand, PARAMETERS, by_parameters};
use super::information::{Information, PITCH, SHARED, SPEED_SCALE, Slopes, covariance, unit};
use super::sensors::LastingErrors;
use super::steady_drive::{SideBalance, SteadyDrive, SteadyWheel};

/// Channels of a side: three torques, four balances, three sinkages.
const CHANNELS: usize = 10;
/// Where the balances begin.
const BALANCES: usize = 3;
/// Where the sinkages begin.
const SINKAGES: usize = 7;
/// Errors of a side: slip, load, torque, pull and sinkage of three wheels; the pitch.
const ERRORS: usize = 16;
/// What stands for no knowledge at all of a force (N) or a torque (N·m).
const UNSEEN: f64 = 1e3;

/// A change of the channels.
type Change = SVector<f64, CHANNELS>;

/// How a rover is measured, and what is known beforehand.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RoverMeasurement {
    /// One standard deviation of the sinkage of a wheel in one frame, m; none where nothing measures it.
    pub sinkage_m: Option<f64>,
    /// What uneven ground adds to the drawbar pull of a wheel in one frame, N, one standard deviation.
    pub ground_n: f64,
    /// What lasts.
    pub lasting: LastingErrors,
    /// What is known of the soil.
    pub beforehand: Beforehand,
}

impl RoverMeasurement {
    /// What one frame of a steady drive says to the sensors of one side, with the noise of the rover's sensors; none where
    /// it cannot be computed.
    pub fn information(
        &self,
        rover: &Rover<f64>,
        soil: &Soil<f64>,
        balance: &SideBalance,
        drive: &SteadyDrive,
    ) -> Option<Information> {
        let side = Changes { rover, soil, balance };
        let noise = &rover.noise;
        let gravity = rover.gravity_m_s2;
        let mut errors = SMatrix::<f64, CHANNELS, ERRORS>::zeros();
        let mut slopes = Slopes::<CHANNELS>::zeros();
        let parameters = self.beforehand.standardised();
        for (place, wheel) in drive.wheels.into_array().iter().enumerate() {
            let slip_std = slip_std(rover, wheel, drive.hub_speed_m_s);
            let by_slip = side.by_slip(place, wheel);
            let by_load = side.by_load(place, wheel);
            let drive_torque = unit::<CHANNELS>(place);
            // What holds a wheel that is held, nobody knows.
            let (torque, pull_n) = match wheel.response {
                Some(_) => (drive_torque * noise.motor_torque_nm, self.ground_n),
                None => (side.by_torque(place) * UNSEEN, UNSEEN),
            };
            errors.set_column(place, &(by_slip * slip_std));
            errors.set_column(3 + place, &(by_load * noise.load_cell_n));
            errors.set_column(6 + place, &torque);
            errors.set_column(9 + place, &(side.by_pull(place) * pull_n));
            errors.set_column(12 + place, &(unit::<CHANNELS>(SINKAGES + place) * self.sinkage_m.unwrap_or(1.0)));
            for (parameter, column) in side.by_soil(place, wheel).column_iter().enumerate() {
                let mut sum = slopes.column_mut(parameter);
                sum += column * parameters[parameter].scale;
            }
            let mut by_scale = slopes.column_mut(SPEED_SCALE);
            by_scale += by_slip * ((1.0 - wheel.slip.abs()) * self.lasting.speed_scale);
            slopes.set_column(SHARED + place, &(by_load * self.lasting.load_n));
            slopes.set_column(SHARED + 3 + place, &(drive_torque * self.lasting.torque_nm));
        }
        let by_pitch = in_balances(&balance.weight_by_pitch);
        errors.set_column(ERRORS - 1, &(by_pitch * (noise.accel_m_s2 / gravity)));
        slopes.set_column(PITCH, &(by_pitch * self.lasting.pitch_rad));
        Information::new(slopes, &covariance(&errors), if self.sinkage_m.is_some() { CHANNELS } else { SINKAGES })
    }
}

/// Noise of the slip of a wheel in one frame, from those of hub speed and wheel rate.
fn slip_std(rover: &Rover<f64>, wheel: &SteadyWheel, hub_speed_m_s: f64) -> f64 {
    let (rim, noise) = (wheel.rim_speed_m_s, &rover.noise);
    let faster = rim.max(hub_speed_m_s).max(1e-6);
    let ratio = rim.min(hub_speed_m_s) / faster;
    let (of_faster, of_slower) = if rim >= hub_speed_m_s {
        (noise.wheel_rate_rad_s * rover.wheel.radius_m, noise.velocity_m_s)
    } else {
        (noise.velocity_m_s, noise.wheel_rate_rad_s * rover.wheel.radius_m)
    };
    (of_slower / faster).hypot(ratio * of_faster / faster)
}

/// A change of the balances as one of the channels.
fn in_balances(change: &SVector<f64, 4>) -> Change {
    let mut channels = Change::zeros();
    channels.fixed_rows_mut::<4>(BALANCES).copy_from(change);
    channels
}

/// How the channels change.
struct Changes<'a> {
    rover: &'a Rover<f64>,
    soil: &'a Soil<f64>,
    balance: &'a SideBalance,
}

impl Changes<'_> {
    fn by_pull(&self, place: usize) -> Change {
        in_balances(&self.balance.by_wheels.column(place).into_owned())
    }

    fn by_torque(&self, place: usize) -> Change {
        in_balances(&self.balance.by_wheels.column(6 + place).into_owned()) + unit::<CHANNELS>(place)
    }

    /// By pull, torque and sinkage as the soil predicts them.
    fn by_prediction(&self, place: usize) -> SMatrix<f64, CHANNELS, 3> {
        SMatrix::from_columns(&[self.by_pull(place), self.by_torque(place), unit::<CHANNELS>(SINKAGES + place)])
    }

    fn by_slip(&self, place: usize, wheel: &SteadyWheel) -> Change {
        wheel.response.map_or_else(Change::zeros, |response| self.by_prediction(place) * response.by_slip)
    }

    fn by_load(&self, place: usize, wheel: &SteadyWheel) -> Change {
        let direct = in_balances(&self.balance.by_wheels.column(3 + place).into_owned());
        direct + wheel.response.map_or_else(Change::zeros, |response| self.by_prediction(place) * response.by_load)
    }

    fn by_soil(&self, place: usize, wheel: &SteadyWheel) -> SMatrix<f64, CHANNELS, PARAMETERS> {
        let Some(response) = wheel.response else { return SMatrix::zeros() };
        self.by_prediction(place) * by_parameters(response.by_soil, &self.rover.wheel, self.soil)
    }
}
