//! What declared effects follow beside slip, load and forces, of a row and of a mean over rows.

use kapvik_firmware::terramechanics::effects::{Column, Conditions, Form};

use crate::data::campaign::{Campaign, Channel, DeclaredEffect};

/// The column that a form follows and that a wheel's state, with what is known beside it, does not have; none where it has all.
pub fn lacking(conditions: &Conditions<f64>, form: &Form) -> Option<Channel> {
    let lacked = form.needs.iter().find(|column| !is_known(conditions, **column));
    lacked.and_then(|column| Channel::read_from(*column))
}

fn is_known(conditions: &Conditions<f64>, column: Column) -> bool {
    match column {
        // Every state has the forces that it is identified by, and what is not measured of it is told by these.
        Column::DrawbarPull | Column::Load | Column::Torque | Column::Sinkage | Column::Grousers => true,
        // No method of identification weighs it.
        Column::SideForce => false,
        Column::SlipAngle => conditions.slip_angle_rad.is_some(),
        Column::WheelRate | Column::Speed => conditions.wheel_rate_rad_s.or(conditions.speed_m_s).is_some(),
        Column::WheelAngle => conditions.wheel_angle_rad.is_some(),
        Column::Pass => conditions.pass.is_some(),
        Column::Temperature => conditions.temperature_c.is_some(),
        Column::HoursSinceZero => conditions.hours_since_zero.is_some(),
        Column::Travel => conditions.travel_m.is_some(),
        Column::Pitch => conditions.pitch_rad.is_some(),
    }
}

/// Means, each over those that have it. A law that bends says at the mean of what it follows not the mean of what it says; for one that is
/// straight, as a drift is, it does. The angle of a wheel has no mean: what follows it goes round.
pub fn mean_conditions(rows: &[Conditions<f64>]) -> Conditions<f64> {
    if let [only] = rows {
        return *only;
    }
    let mean = |of: fn(&Conditions<f64>) -> Option<f64>| {
        let (sum, count) = rows.iter().filter_map(of).fold((0.0, 0_u32), |(sum, count), one| (sum + one, count + 1));
        (count > 0).then(|| sum / f64::from(count))
    };
    Conditions {
        pass: mean(|row| row.pass),
        temperature_c: mean(|row| row.temperature_c),
        hours_since_zero: mean(|row| row.hours_since_zero),
        speed_m_s: mean(|row| row.speed_m_s),
        wheel_rate_rad_s: mean(|row| row.wheel_rate_rad_s),
        wheel_angle_rad: None,
        travel_m: mean(|row| row.travel_m),
        pitch_rad: mean(|row| row.pitch_rad),
        slip_angle_rad: mean(|row| row.slip_angle_rad),
        felt_slip: None,
    }
}

/// What is to be said of the forms of effects that a campaign declares, where the method takes these in.
pub fn remarks(campaign: &Campaign) -> Vec<String> {
    campaign.declared.effects.iter().filter_map(|effect| remark(campaign, effect)).collect()
}

fn remark(campaign: &Campaign, effect: &DeclaredEffect) -> Option<String> {
    let id = effect.info.id;
    let lacked = |form: &Form| {
        let of_rows = (0..campaign.rows().len()).map(|row| lacking(&campaign.conditions(row), form));
        of_rows.reduce(|one, other| one.and(other)).flatten()
    };
    let may_be: Vec<&Form> = match effect.form {
        Some(form) => vec![form],
        None => effect.open_forms().collect(),
    };
    let lacked: Vec<Option<Channel>> = may_be.into_iter().map(lacked).collect();
    let tried = lacked.iter().filter(|lacked| lacked.is_none()).count();
    match lacked.first().copied().flatten() {
        Some(channel) if tried == 0 => {
            let channel = channel.name();
            Some(format!(
                "{id} is declared and does nothing here: what it follows, {channel}, no state that is identified has"
            ))
        }
        _ if tried > 1 => Some(format!(
            "the form of {id} is not declared: each run is taken to have the one that explains it best, of those that follow what is measured"
        )),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_is_over_those_that_have_it() {
        let row = |hours, angle| Conditions {
            hours_since_zero: hours,
            wheel_angle_rad: Some(angle),
            ..Conditions::default()
        };
        let mean = mean_conditions(&[row(Some(1.0), 0.3), row(None, 0.4), row(Some(2.0), 6.0)]);
        assert_eq!((mean.hours_since_zero, mean.wheel_angle_rad, mean.pass), (Some(1.5), None, None));
        assert_eq!(mean_conditions(&[row(None, 0.3)]).wheel_angle_rad, Some(0.3));
    }
}
