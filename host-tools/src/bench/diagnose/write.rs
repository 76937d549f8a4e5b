//! A drawn campaign as the files that a person would bring.

use std::fmt::Write as _;
use std::path::Path;

use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::terramechanics::effects::speed_ratio;

use super::chance::Chance;
use super::instruments::Instruments;
use super::knowledge::Knowledge;
use super::layout::Layout;
use super::site::Site;
use super::state::{MEASURED, Setting, State};
use super::wants::Wants;
use crate::data::atomic_write::write_text;
use crate::data::campaign::{Campaign, Channel};
use crate::error::HostError;

/// Share of campaigns that have an optional column, where it says something.
const COLUMN_SHARE: f64 = 0.4;
/// Share of campaigns with a column that the format does not name.
const EXTRA_SHARE: f64 = 0.3;
/// Such columns.
const EXTRA_COLUMNS: [&str; 4] = ["humidity", "supply_voltage_v", "bin_level_mm", "bearing_noise_db"];

/// The columns beside the measured channels.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    named: Vec<Channel>,
    extra: Option<&'static str>,
}

impl Columns {
    /// Those that are needed, and some of the others; none where the layout gives a needed one nothing to say.
    pub fn draw(
        chance: &mut Chance,
        layout: &Layout,
        wants: &Wants,
        extra_needed: Option<&'static str>,
    ) -> Option<Self> {
        let needed = |channel: &Channel| wants.columns.contains(channel);
        let sensible = |channel: &Channel| MEASURED.contains(channel) || layout.meaningful.contains(channel);
        if !wants.columns.iter().all(sensible) {
            return None;
        }
        let named = layout.meaningful.iter().copied().filter(|channel| {
            // What a wheel does sideways is no detail that a file would leave out.
            let kept = *channel == Channel::SlipAngle || chance.happens(COLUMN_SHARE);
            kept || needed(channel)
        });
        let named = named.collect();
        let extra = extra_needed.or_else(|| chance.happens(EXTRA_SHARE).then(|| chance.pick(&EXTRA_COLUMNS)));
        Some(Self { named, extra })
    }
}

/// The texts of a campaign's two files.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// `NAME.csv`
    pub csv: String,
    /// `NAME.toml`
    pub toml: String,
    /// `NAME.truth.toml`, the soil as it is: for `close-loop`, which says how wrong its estimates are.
    pub truth: String,
}

impl Written {
    /// The files of a campaign, from the readings without noise and the fields as they were measured.
    pub fn new(
        chance: &mut Chance,
        site: &Site,
        layout: &Layout,
        instruments: &Instruments,
        knowledge: &Knowledge,
        columns: &Columns,
        (readings, fields): (&[State], &[[Option<f64>; 6]]),
    ) -> Self {
        let csv = csv(chance, site, layout, instruments, columns, readings, fields);
        Self { csv, toml: toml(site, instruments, knowledge), truth: truth(&site.soil) }
    }

    /// The campaign as a tool reads it.
    ///
    /// # Errors
    /// Where these are not the files of a campaign.
    pub fn campaign(&self, name: &str) -> Result<Campaign, HostError> {
        Campaign::parse(Path::new(&format!("{name}.csv")), &self.csv, &self.toml)
    }

    /// Writes `NAME.csv`, `NAME.toml`, `NAME.truth.toml` and, for a person who wants to know, `NAME.truth.txt`.
    ///
    /// # Errors
    /// Where the file system refuses.
    pub fn save(&self, folder: &Path, name: &str, laws: &str) -> Result<(), HostError> {
        write_text(&folder.join(format!("{name}.csv")), &self.csv)?;
        write_text(&folder.join(format!("{name}.toml")), &self.toml)?;
        write_text(&folder.join(format!("{name}.truth.toml")), &self.truth)?;
        write_text(&folder.join(format!("{name}.truth.txt")), laws)
    }
}

fn csv(
    chance: &mut Chance,
    site: &Site,
    layout: &Layout,
    instruments: &Instruments,
    columns: &Columns,
    readings: &[State],
    fields: &[[Option<f64>; 6]],
) -> String {
    let measured: Vec<usize> = (0..MEASURED.len()).filter(|place| instruments.measures(*place)).collect();
    let mut header = vec!["run", "t_s"];
    header.extend(measured.iter().map(|place| MEASURED[*place].name()));
    header.extend(columns.named.iter().map(|channel| channel.name()));
    header.extend(columns.extra);
    let mut text = header.join(",") + "\n";
    for ((row, reading), fields) in layout.rows.iter().zip(readings).zip(fields) {
        let mut line = vec![format!("r{:02}", row.run + 1), plain(row.t_s, 0.01)];
        for place in &measured {
            line.push(fields[*place].map_or_else(String::new, |value| plain(value, instruments.resolution(*place))));
        }
        let setting = as_seen(&row.setting, site, reading);
        for channel in &columns.named {
            let (value, step) = optional(*channel, &setting);
            let gone = chance.happens(0.3 * instruments.missing) && *channel == Channel::Temperature;
            line.push(if gone { String::new() } else { plain(value, step) });
        }
        line.extend(columns.extra.map(|_| plain(row.setting.other, 0.1)));
        text += &line.join(",");
        text.push('\n');
    }
    text
}

/// The setting as the campaign's own instruments have it: slip is computed from speed and rate, so the three agree.
fn as_seen(setting: &Setting, site: &Site, reading: &State) -> Setting {
    let rim_speed_m_s = setting.wheel_rate_rad_s * site.wheel.radius_m;
    Setting { speed_m_s: rim_speed_m_s * speed_ratio(reading.slip), ..*setting }
}

/// The value of an optional column, and the step to which it is written.
fn optional(channel: Channel, setting: &Setting) -> (f64, f64) {
    match channel {
        Channel::Pass => (setting.pass, 1.0),
        Channel::Temperature => (setting.temperature_c, 0.1),
        Channel::HoursSinceZero => (setting.hours_since_zero, 0.001),
        Channel::WheelRate => (setting.wheel_rate_rad_s, 1e-4),
        Channel::Speed => (setting.speed_m_s, 1e-5),
        Channel::WheelAngle => (setting.wheel_angle_rad, 1e-3),
        Channel::Travel => (setting.travel_m, 1e-4),
        Channel::Pitch => (setting.pitch_rad, 1e-4),
        Channel::SlipAngle => (setting.slip_angle_rad, 1e-4),
        // The measured channels and the time stand elsewhere.
        _ => (0.0, 1.0),
    }
}

/// A number with the digits of its step, and none more.
fn plain(value: f64, step: f64) -> String {
    let decimals = (-libm::log10(step) - 1e-9).ceil().max(0.0) as usize;
    let text = format!("{:.decimals$}", (value / step).round() * step);
    if text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.') { text.replace('-', "") } else { text }
}

fn toml(site: &Site, instruments: &Instruments, knowledge: &Knowledge) -> String {
    let mut text = format!(
        "name = \"Simulated campaign\"\nkind = \"simulated\"\nsource = \"drawn by kapvik bench diagnose\"\n\
         gravity_m_s2 = {}\n[wheel]\nradius_m = {:.4}\nwidth_m = {:.4}\ngrouser_height_m = {:.4}\ngrouser_count = {}\n\
         [soil]\n{}[noise]\n",
        site.gravity_m_s2,
        site.wheel.radius_m,
        site.wheel.width_m,
        site.grousers.height_m,
        site.grousers.count,
        knowledge.toml()
    );
    for (place, channel) in MEASURED.iter().enumerate() {
        if let Some(std) = instruments.noise[place].filter(|_| instruments.stated[place]) {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{} = {std:.3e}", channel.name());
        }
    }
    text + "[declared]\neffects = []\n"
}

/// The soil as a file that [`crate::data::soil_file::SoilTable`] reads.
fn truth(soil: &Soil<f64>) -> String {
    format!(
        "[soil]\nn = {:?}\nk_eff = {:?}\nc = {:?}\nphi = {:?}\nK = {:?}\nc1 = {:?}\nc2 = {:?}\n",
        soil.sinkage_exponent,
        soil.frictional_modulus,
        soil.cohesion_pa,
        soil.friction_angle_rad,
        soil.shear_modulus_m,
        soil.peak_stress_c1,
        soil.peak_stress_c2
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_to_their_step() {
        assert_eq!(plain(1.234_56, 0.02), "1.24");
        assert_eq!(plain(12.3, 5.0), "10");
        assert_eq!(plain(-0.001, 0.01), "0.00");
        assert_eq!(plain(0.012_34, 1e-4), "0.0123");
    }
}
