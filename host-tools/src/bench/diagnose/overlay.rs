//! Laws that the library does not have, laid over its equations: other forms of listed effects, and effects of no list.

use kapvik_firmware::terramechanics::{Soil, WheelForces, sinkage_for_load, wheel_forces};

use super::site::Site;
use super::state::{Row, Setting, State};
use super::stress::{StressPoint, integrate};

/// Where a wheel is, and in what setting.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    /// Wheel, soil and loads.
    pub site: &'a Site,
    /// What surrounds it.
    pub setting: &'a Setting,
    /// True slip.
    pub slip: f64,
    /// True load, N.
    pub load_n: f64,
    /// Sinkage, m.
    pub sinkage_m: f64,
}

/// How a law acts; the last argument is its size, 0 where it does not act.
#[derive(Debug, Clone, Copy)]
pub enum Act {
    /// The soil differs from place to place.
    Soil(fn(&Place<'_>, f64) -> Soil<f64>),
    /// Another shear stress, Pa, in place of equation 1.
    Shear(fn(&Place<'_>, &StressPoint, f64) -> f64),
    /// A factor on the sinkage at the same load; the soil that carries it there is that much softer.
    Sinkage(fn(&Place<'_>, f64) -> f64),
    /// What forces and sinkage are beside what the stresses give, or what the sensors make of them.
    State(fn(&Place<'_>, &mut State, f64)),
    /// What the readings of a run become, in the order of its rows.
    Run(fn(&Site, &[Row], &mut [State], f64)),
}

impl Act {
    /// The state of a wheel at a slip and a load (N); none where the soil cannot carry it.
    pub fn state(self, site: &Site, row: &Row, size: f64) -> Option<State> {
        let place = |sinkage_m| Place { site, setting: &row.setting, slip: row.slip, load_n: row.load_n, sinkage_m };
        let plain_m = || sinkage_for_load(&site.wheel, &site.soil, row.slip, row.load_n).ok();
        let on = |soil: &Soil<f64>, sinkage_m| wheel_forces(&site.wheel, soil, row.slip, sinkage_m).ok();
        let (sinkage_m, forces) = match self {
            Self::Soil(law) => balance(site, row.load_n, |sinkage_m| on(&law(&place(sinkage_m), size), sinkage_m))?,
            Self::Shear(law) => balance(site, row.load_n, |sinkage_m| {
                let place = place(sinkage_m);
                Some(integrate(&place, |point| law(&place, point, size)))
            })?,
            Self::Sinkage(law) => {
                let plain_m = plain_m()?;
                let sinkage_m = plain_m * law(&place(plain_m), size);
                (sinkage_m, softened(site, row, sinkage_m)?)
            }
            Self::State(_) | Self::Run(_) => {
                let sinkage_m = plain_m()?;
                (sinkage_m, on(&site.soil, sinkage_m)?)
            }
        };
        let mut state = State {
            drawbar_pull_n: forces.drawbar_pull_n,
            torque_nm: forces.torque_nm,
            sinkage_m,
            side_force_n: 0.0,
            slip: row.slip,
            load_n: row.load_n,
        };
        if let Self::State(law) = self {
            law(&place(sinkage_m), &mut state, size);
        }
        Some(state)
    }
}

/// The forces at a sinkage on a soil whose moduli are scaled so that it carries the load there. The load is a linear
/// function of the moduli.
fn softened(site: &Site, row: &Row, sinkage_m: f64) -> Option<WheelForces<f64>> {
    let scaled = |factor: f64| Soil {
        cohesive_modulus: factor * site.soil.cohesive_modulus,
        frictional_modulus: factor * site.soil.frictional_modulus,
        ..site.soil
    };
    let forces = |factor| wheel_forces(&site.wheel, &scaled(factor), row.slip, sinkage_m).ok();
    let (without, with) = (forces(0.0)?.load_n, forces(1.0)?.load_n);
    let factor = (row.load_n - without) / (with - without);
    if factor > 0.0 { forces(factor) } else { None }
}

/// The least sinkage (m) at which `forces` carries a load (N), and the forces there: a bracket is found from the surface
/// downward, and narrowed by the Illinois method on the logarithms of load and sinkage.
fn balance(
    site: &Site,
    load_n: f64,
    forces: impl Fn(f64) -> Option<WheelForces<f64>>,
) -> Option<(f64, WheelForces<f64>)> {
    const DOWNWARD: f64 = 2.0;
    const STEPS: usize = 60;
    let excess = |ln_m: f64| forces(libm::exp(ln_m)).map(|forces| libm::log(forces.load_n.max(1e-9) / load_n));
    let bottom = libm::log(0.9 * site.wheel.radius_m);
    let mut low = libm::log(3e-3 * site.wheel.radius_m);
    let (mut at_low, mut high) = (excess(low)?, low);
    let mut at_high = at_low;
    while at_high < 0.0 {
        (low, at_low) = (high, at_high);
        high += libm::log(DOWNWARD);
        if high > bottom {
            return None;
        }
        at_high = excess(high)?;
    }
    if at_low >= 0.0 {
        return None;
    }
    for _ in 0..STEPS {
        let middle = (low * at_high - high * at_low) / (at_high - at_low);
        let at_middle = excess(middle)?;
        if at_middle.abs() < 1e-10 {
            let sinkage_m = libm::exp(middle);
            return Some((sinkage_m, forces(sinkage_m)?));
        }
        if at_middle * at_high < 0.0 {
            (low, at_low) = (high, at_high);
        } else {
            at_low *= 0.5;
        }
        (high, at_high) = (middle, at_middle);
    }
    None
}
