//! What truly happens in a drawn campaign: the equations with whatever nobody declared.

use kapvik_firmware::terramechanics::effects::{Conditions, Effects, Grousers};
use kapvik_firmware::terramechanics::{Memory, Quadrature, Readings, WheelOnSoil};

use super::overlay::Act;
use super::site::Site;
use super::state::{Row, Setting, State};
use crate::prior::DEEPEST;

/// What acts beside equations 1–11.
#[derive(Debug, Clone, Copy)]
pub struct Undeclared {
    /// Effects as the library has them.
    pub effects: Effects<f64>,
    /// A law that the library does not have, and its size.
    pub overlay: Option<(Act, f64)>,
}

impl Undeclared {
    /// Nothing: the seed's model.
    pub fn nothing() -> Self {
        Self { effects: Effects::none(), overlay: None }
    }

    /// What sensors without noise read in each row of a campaign; none where the soil cannot carry a wheel, or lets it sink
    /// deeper than any that is driven on.
    pub fn readings(&self, site: &Site, rows: &[Row]) -> Option<Vec<State>> {
        let mut states = Vec::with_capacity(rows.len());
        for run in rows.chunk_by(|a, b| a.run == b.run) {
            let mut memory = Memory::start();
            let first = states.len();
            for row in run {
                states.push(self.row(site, row, &mut memory)?);
            }
            if let Some((Act::Run(law), size)) = self.overlay {
                law(site, run, &mut states[first..], size);
            }
        }
        let possible = |state: &State| (-1.0..=1.0).contains(&state.slip) && state.load_n > 0.0;
        states.iter().all(possible).then_some(states)
    }

    fn row(&self, site: &Site, row: &Row, memory: &mut Memory<f64>) -> Option<State> {
        let state = match self.overlay {
            Some((act, size)) => act.state(site, row, size)?,
            None => library_state(site, &self.effects, row, memory)?,
        };
        (state.sinkage_m <= DEEPEST * site.wheel.radius_m).then_some(state)
    }
}

fn library_state(site: &Site, effects: &Effects<f64>, row: &Row, memory: &mut Memory<f64>) -> Option<State> {
    let grousers = Grousers { height_m: site.grousers.height_m, count: f64::from(site.grousers.count) };
    let wheel = WheelOnSoil {
        wheel: &site.wheel,
        grousers: &grousers,
        soil: &site.soil,
        effects,
        gravity_m_s2: site.gravity_m_s2,
        quadrature: Quadrature::for_scalar::<f64>(),
    };
    let conditions = conditions(&row.setting);
    let truth = wheel.at_load(&conditions, row.slip, row.load_n).ok()?;
    let Readings { slip, load_n, drawbar_pull_n, torque_nm, sinkage_m, side_force_n } =
        wheel.readings(&conditions, &truth, memory);
    Some(State { drawbar_pull_n, torque_nm, sinkage_m, side_force_n, slip, load_n })
}

/// All that surrounds a row, whether the campaign will have a column for it or not.
fn conditions(setting: &Setting) -> Conditions<f64> {
    Conditions {
        pass: Some(setting.pass),
        temperature_c: Some(setting.temperature_c),
        hours_since_zero: Some(setting.hours_since_zero),
        speed_m_s: Some(setting.speed_m_s),
        wheel_rate_rad_s: Some(setting.wheel_rate_rad_s),
        wheel_angle_rad: Some(setting.wheel_angle_rad),
        travel_m: Some(setting.travel_m),
        pitch_rad: Some(setting.pitch_rad),
        slip_angle_rad: Some(setting.slip_angle_rad),
        felt_slip: None,
    }
}
