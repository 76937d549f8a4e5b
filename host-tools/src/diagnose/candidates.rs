//! Which effects could be in a campaign: those whose columns it has.

use kapvik_firmware::terramechanics::effects::{CATALOGUE, Column, Conditions, EffectInfo, Form};

use crate::data::campaign::Campaign;
use crate::statistics::ends;

use super::fit::Reading;
use super::measurements::{Measurements, varies};
use super::specification::{EffectForm, Specification};

/// Spread of load, as a share, below which it counts as one level.
const ONE_LOAD: f64 = 0.1;
/// The same of speed and wheel rate.
const ONE_SPEED: f64 = 0.1;

/// Effects of the sensors of forces.
const SENSOR_EFFECTS: [&str; 3] = ["force-bias", "force-drift", "crosstalk"];

/// Every form of every effect that a model does not have yet, and that the measurements could show.
pub fn candidates(campaign: &Campaign, measurements: &Measurements, model: &Specification) -> Vec<EffectForm> {
    let others = CATALOGUE.iter().filter(|info| !model.has(info.id));
    let others = others.filter(|info| !is_by_load(info) || loads_differ(measurements));
    let forms = others.flat_map(EffectForm::each_of);
    let forms = forms.filter(|candidate| !is_of_load_sensor(candidate) || !measurements.is_load_set);
    forms.filter(|candidate| is_measured(campaign, measurements, candidate.form)).collect()
}

/// Whether an effect is what a load makes of the soil against another load.
pub fn is_by_load(info: &EffectInfo) -> bool {
    info.parameters.iter().any(|parameter| parameter.name == "reference_load_n")
}

/// Whether an effect is an error of the load's sensor, or of another that the load leaks into.
fn is_of_load_sensor(candidate: &EffectForm) -> bool {
    SENSOR_EFFECTS.contains(&candidate.info.id) && candidate.form.needs.contains(&Column::Load)
}

/// Whether the loads are more than one level, about which they scatter.
pub fn loads_differ(measurements: &Measurements) -> bool {
    differ(measurements.rows.iter().filter_map(|row| row.readings[Reading::Load.index()]), ONE_LOAD)
}

/// Whether the wheel rates are more than one level.
pub fn rates_differ(measurements: &Measurements) -> bool {
    differ(measurements.conditions.iter().filter_map(|row| row.wheel_rate_rad_s), ONE_SPEED)
}

/// Whether the range of some numbers is at least a share of the largest.
fn differ(values: impl Iterator<Item = f64>, share: f64) -> bool {
    ends(values).is_some_and(|(low, high)| high > low && high - low >= share * high.abs())
}

/// Whether a campaign has what a form needs.
pub fn is_measured(campaign: &Campaign, measurements: &Measurements, form: &Form) -> bool {
    form.needs.iter().all(|column| has(campaign, measurements, *column))
}

fn has(campaign: &Campaign, measurements: &Measurements, column: Column) -> bool {
    let varies = |value: fn(&Conditions<f64>) -> Option<f64>| varies(measurements.conditions.iter().filter_map(value));
    match column {
        Column::DrawbarPull => measurements.has(Reading::DrawbarPull),
        Column::Load => measurements.has(Reading::Load),
        Column::Torque => measurements.has(Reading::Torque),
        Column::Sinkage => measurements.has(Reading::Sinkage),
        Column::SideForce => measurements.has(Reading::SideForce),
        Column::SlipAngle => varies(|row| row.slip_angle_rad) || measurements.conditions.iter().any(slides),
        Column::WheelRate => rates_differ(measurements),
        Column::Speed => differ(measurements.speeds_m_s().flatten(), ONE_SPEED),
        Column::WheelAngle => varies(|row| row.wheel_angle_rad),
        Column::Pass => varies(|row| row.pass),
        Column::Temperature => varies(|row| row.temperature_c),
        Column::HoursSinceZero => varies(|row| row.hours_since_zero),
        Column::Travel => varies(|row| row.travel_m),
        Column::Pitch => varies(|row| row.pitch_rad),
        Column::Grousers => campaign.grousers.count > 0,
    }
}

fn slides(conditions: &Conditions<f64>) -> bool {
    conditions.slip_angle_rad.is_some_and(|angle| angle != 0.0)
}
