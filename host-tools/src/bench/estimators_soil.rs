//! How good the soil estimate is on simulated drives, and how soon it notices that the soil changed.

use crate::trial::{Drive, SoilPoint, Trial};

/// Seconds after the first frame at which the soil is looked at: the rovers start at 1 s.
const LOOK_S: f64 = 31.0;

/// Errors of one drive's estimate, with what it stated.
struct Errors {
    friction_angle_deg: f64,
    friction_angle_std_deg: f64,
    ln_shear_modulus: f64,
    ln_shear_modulus_std: f64,
}

/// Prints both.
pub fn print(trial: &Trial) {
    let errors: Vec<Errors> = trial.drives.iter().filter_map(|drive| errors(after_30_s(drive)?)).collect();
    let count = errors.len().max(1) as f64;
    let rms = |pick: fn(&Errors) -> f64| (errors.iter().map(|row| pick(row).powi(2)).sum::<f64>() / count).sqrt();
    let within = errors.iter().filter(|row| row.friction_angle_deg.abs() <= 2.0 * row.friction_angle_std_deg).count();
    println!(
        "  soil after 30 s: φ RMSE {:.2}°, stated {:.2}°, within 2 σ in {:.0} % of {count} drives; ln K RMSE {:.3}, stated {:.3}",
        rms(|row| row.friction_angle_deg),
        rms(|row| row.friction_angle_std_deg),
        100.0 * within as f64 / count,
        rms(|row| row.ln_shear_modulus),
        rms(|row| row.ln_shear_modulus_std),
    );
    let noticed: Vec<f64> = trial.drives.iter().filter_map(noticed_after_m).collect();
    let changed = trial.drives.iter().filter(|drive| changed_at(drive).is_some()).count();
    let claimed: usize =
        trial.drives.iter().map(|drive| drive.soils.last().map_or(0, |point| usize::from(point.said.changes))).sum();
    let latest = noticed.iter().copied().fold(0.0, f64::max);
    println!(
        "  soil changes: {changed} true, {} noticed, the latest after {latest:.2} m; {} claimed beside",
        noticed.len(),
        claimed - noticed.len(),
    );
}

fn after_30_s(drive: &Drive) -> Option<&SoilPoint> {
    drive.soils.iter().find(|point| point.truth.time_us as f64 * 1.0e-6 >= LOOK_S)
}

fn errors(point: &SoilPoint) -> Option<Errors> {
    let (said, truth) = (&point.said.estimate, &point.truth.soil);
    let (phi, modulus) = (said.friction_angle_rad, said.shear_modulus_m);
    (modulus.value > 0.0).then(|| Errors {
        friction_angle_deg: (f64::from(phi.value) - truth.friction_angle_rad).to_degrees(),
        friction_angle_std_deg: f64::from(phi.std).to_degrees(),
        ln_shear_modulus: (f64::from(modulus.value) / truth.shear_modulus_m).ln(),
        ln_shear_modulus_std: f64::from(modulus.std / modulus.value),
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
