//! Which effects could be in a campaign: those whose columns it has.

use kapvik_firmware::terramechanics::effects::{CATALOGUE, Column, Conditions, Form};

use crate::data::campaign::Campaign;

use super::fit::Reading;
use super::measurements::Measurements;
use super::specification::{EffectForm, Specification};

/// Every form of every effect that a model does not have yet, and that the measurements could show.
pub fn candidates(campaign: &Campaign, measurements: &Measurements, model: &Specification) -> Vec<EffectForm> {
    let others = CATALOGUE.iter().filter(|info| !model.has(info.id));
    let forms = others.flat_map(|info| info.forms.iter().map(move |form| EffectForm::new(info, form)));
    forms.filter(|candidate| is_measured(campaign, measurements, candidate.form)).collect()
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
        Column::WheelRate | Column::Speed => varies(|row| row.wheel_rate_rad_s) || varies(|row| row.speed_m_s),
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

/// Whether some numbers differ by more than their rounding.
fn varies(values: impl Iterator<Item = f64>) -> bool {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    high - low > 1e-6 * (low.abs() + high.abs())
}
