//! How good the soil estimate is on simulated drives, and how soon it notices that the soil changed.

use crate::identifiability::bound::Bound;
use crate::parameter::Parameter;
use crate::statistics::root_mean_square;
use crate::trial::{Drive, SOIL_LOOK_S, SoilPoint, Trial};

/// Errors of one drive's estimate, with what it stated and the bound on what any could reach.
#[derive(Debug, Clone, Copy)]
struct Errors {
    friction_angle_deg: f64,
    friction_angle_std_deg: f64,
    friction_angle_bound_deg: f64,
    ln_shear_modulus: f64,
    ln_shear_modulus_std: f64,
    ln_shear_modulus_bound: f64,
}

/// Errors of the soil estimate thirty seconds after the start, drive by drive.
#[derive(Debug, Clone)]
pub struct SoilErrors {
    drives: Vec<Errors>,
}

impl SoilErrors {
    /// The errors of a trial's drives.
    pub fn after_30_s(trial: &Trial) -> Self {
        Self {
            drives: trial.drives.iter().filter_map(|drive| errors(after_30_s(drive)?, &drive.soil_bound?)).collect(),
        }
    }

    /// Share of the drives in which the friction angle is within two of its stated standard deviations.
    pub fn within_two_std(&self) -> f64 {
        let within = |row: &&Errors| row.friction_angle_deg.abs() <= 2.0 * row.friction_angle_std_deg;
        self.drives.iter().filter(within).count() as f64 / self.drives.len().max(1) as f64
    }

    /// Root mean square, over the drives, of the friction angle's errors, their stated standard deviations and the bounds on
    /// them, °.
    pub fn friction_angle_deg(&self) -> [f64; 3] {
        [
            self.root_mean_square(|row| row.friction_angle_deg),
            self.root_mean_square(|row| row.friction_angle_std_deg),
            self.root_mean_square(|row| row.friction_angle_bound_deg),
        ]
    }

    /// The same of ln K.
    pub fn ln_shear_modulus(&self) -> [f64; 3] {
        [
            self.root_mean_square(|row| row.ln_shear_modulus),
            self.root_mean_square(|row| row.ln_shear_modulus_std),
            self.root_mean_square(|row| row.ln_shear_modulus_bound),
        ]
    }

    fn root_mean_square(&self, pick: fn(&Errors) -> f64) -> f64 {
        root_mean_square(self.drives.iter().map(pick))
    }
}

/// Soil changes of a trial's drives, and what was said of them.
#[derive(Debug, Clone, Copy)]
pub struct SoilChanges {
    /// Drives on which the soil changed.
    pub real: usize,
    /// Changes that were noticed.
    pub noticed: usize,
    /// The longest travel from the front wheels' arrival to the notice, m.
    pub latest_m: f64,
    /// Changes that were said beside these.
    pub claimed_beside: usize,
}

impl SoilChanges {
    /// Those of a trial.
    pub fn of(trial: &Trial) -> Self {
        let noticed: Vec<f64> = trial.drives.iter().filter_map(noticed_after_m).collect();
        let claims = |drive: &Drive| drive.soils.last().map_or(0, |point| usize::from(point.said.changes));
        Self {
            real: trial.drives.iter().filter(|drive| changed_at(drive).is_some()).count(),
            noticed: noticed.len(),
            latest_m: noticed.iter().copied().fold(0.0, f64::max),
            claimed_beside: trial.drives.iter().map(claims).sum::<usize>() - noticed.len(),
        }
    }
}

/// Prints both.
pub(super) fn print(trial: &Trial) {
    let errors = SoilErrors::after_30_s(trial);
    let [phi, phi_stated, phi_bound] = errors.friction_angle_deg();
    let [modulus, modulus_stated, modulus_bound] = errors.ln_shear_modulus();
    println!("  soil after 30 s       RMSE    stated  Cramér–Rao bound");
    println!(
        "  φ, °            {phi:10.2}{phi_stated:10.2}{phi_bound:10.2}   within 2 σ in {:.0} % of the drives",
        100.0 * errors.within_two_std(),
    );
    println!("  ln K            {modulus:10.3}{modulus_stated:10.3}{modulus_bound:10.3}");
    let SoilChanges { real, noticed, latest_m, claimed_beside } = SoilChanges::of(trial);
    println!(
        "  soil changes: {real} real, {noticed} noticed, the latest after {latest_m:.2} m; {claimed_beside} claimed beside"
    );
}

fn after_30_s(drive: &Drive) -> Option<&SoilPoint> {
    drive.soils.iter().find(|point| point.truth.time_us as f64 * 1.0e-6 >= SOIL_LOOK_S)
}

fn errors(point: &SoilPoint, bound: &Bound) -> Option<Errors> {
    let (said, truth) = (&point.said.estimate, &point.truth.soil);
    let (phi, modulus) = (said.friction_angle_rad, said.shear_modulus_m);
    (modulus.value > 0.0).then(|| Errors {
        friction_angle_deg: (f64::from(phi.value) - truth.friction_angle_rad).to_degrees(),
        friction_angle_std_deg: f64::from(phi.std).to_degrees(),
        friction_angle_bound_deg: bound.std(Parameter::FrictionAngle).to_degrees(),
        ln_shear_modulus: (f64::from(modulus.value) / truth.shear_modulus_m).ln(),
        ln_shear_modulus_std: f64::from(modulus.std / modulus.value),
        ln_shear_modulus_bound: bound.std(Parameter::ShearModulus),
    })
}

/// Where the front left wheel met another soil, by the place of the differential axis, m.
fn changed_at(drive: &Drive) -> Option<f64> {
    let soil = |point: &SoilPoint| point.truth.wheels.left.front.soil;
    let first = drive.soils.first().map(soil)?;
    drive.soils.iter().find(|point| soil(point) != first).map(|point| point.truth.x_m)
}

/// Travel from there to the first change that was said after it, m; none where none was.
fn noticed_after_m(drive: &Drive) -> Option<f64> {
    let changed = changed_at(drive)?;
    let before = drive.soils.iter().rev().find(|point| point.truth.x_m < changed).map_or(0, |point| point.said.changes);
    drive.soils.iter().find(|point| point.said.changes > before).map(|point| point.truth.x_m - changed)
}
