//! Numbers that no wheel on a soil can have felt: single ones are gross errors of a sensor, many are in other units.

use crate::error::HostError;
use crate::statistics::median;

use super::{Campaign, Channel};

/// Greatest force at the rim over the load, or over the campaign's typical load where that is greater. A soil's shear
/// strength is of the order of the pressure that it carries; a dragged, locked wheel in sand feels twice its load.
const GREATEST_FORCE: f64 = 5.0;
/// Greatest load over the campaign's typical one, and typical one over the least. A load of nothing, or one that pulls at the soil, is no
/// wheel's on a soil; nor is what a sensor reads about nothing while the wheel is in the air.
const GREATEST_LOAD: f64 = 20.0;
/// Where the load's noise is stated, so many standard deviations about nothing are that as well, up to this share of the typical load.
const ABOUT_NOTHING: f64 = 3.0;
const LIGHTEST: f64 = 0.25;

/// The same of the middle of the rows that drive: one row may feel twice its load, half of them do not. And the fewest rows that have one.
const GREATEST_MEDIAN_FORCE: f64 = 2.5;
const FEWEST: usize = 5;
/// Slip from which a row drives.
const DRIVES: f64 = 0.05;

/// What a campaign's numbers are held against.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plausible {
    /// Median of the loads, N; none where the campaign has none.
    load_n: Option<f64>,
    /// Noise of the load's sensor, N; 0 where it is not stated.
    load_std_n: f64,
}

impl Plausible {
    /// Before a campaign has been looked at.
    pub const fn unknown() -> Self {
        Self { load_n: None, load_std_n: 0.0 }
    }

    /// From a campaign's own loads.
    pub fn of(campaign: &Campaign) -> Self {
        let loads = campaign.column(Channel::Load.name()).unwrap_or(&[]).iter().flatten();
        Self {
            load_n: Some(median(loads.map(|load| load.abs()))).filter(|load| *load > 0.0),
            load_std_n: campaign.noise.of(Channel::Load).unwrap_or(0.0),
        }
    }

    /// What every load is above, N.
    fn least_load_n(self) -> f64 {
        let of_noise = |load_n: f64| (ABOUT_NOTHING * self.load_std_n).min(LIGHTEST * load_n);
        self.load_n.map_or(0.0, |load_n| of_noise(load_n).max(load_n / GREATEST_LOAD))
    }

    /// Whether what is the greatest size of a channel comes of the loads: then these may be what is in other units.
    fn is_by_load(self, channel: Channel) -> bool {
        self.load_n.is_some() && !matches!(channel, Channel::Sinkage | Channel::Load)
    }

    /// A number that cannot be what a wheel felt, and the greatest size that could.
    fn beyond(self, campaign: &Campaign, row: usize, channel: Channel) -> Option<(f64, f64)> {
        let value = campaign.value(row, channel)?;
        let radius_m = campaign.wheel.radius_m;
        let typical = self.load_n.unwrap_or(f64::INFINITY);
        let load_n = campaign.value(row, Channel::Load).map_or(typical, |load| load.abs().max(typical));
        let limit = match channel {
            Channel::Sinkage => radius_m,
            Channel::Load => GREATEST_LOAD * typical,
            Channel::Torque => GREATEST_FORCE * load_n * radius_m,
            _ => GREATEST_FORCE * load_n,
        };
        let is_lifted = channel == Channel::Load && value <= self.least_load_n();
        (value.abs() > limit || is_lifted).then_some((value, limit))
    }
}

/// What is looked at.
const JUDGED: [Channel; 5] =
    [Channel::Sinkage, Channel::Load, Channel::DrawbarPull, Channel::SideForce, Channel::Torque];

impl Campaign {
    /// Why a row's numbers cannot be what a wheel felt; such a row is of no use.
    pub fn gross_error(&self, row: usize) -> Option<String> {
        JUDGED.into_iter().find_map(|channel| {
            let (value, limit) = self.plausible.beyond(self, row, channel)?;
            let (name, unit) = (channel.name(), unit(channel));
            let least = match channel {
                Channel::Load => format!("more than {:.3} {unit} and ", self.plausible.least_load_n()),
                _ => String::new(),
            };
            Some(format!(
                "{name} of {value} {unit} cannot be: it is {least}at most {limit:.3} {unit}, or a gross error"
            ))
        })
    }

    /// The rows without one.
    pub fn sound_rows(&self) -> impl Iterator<Item = usize> {
        (0..self.rows().len()).filter(|row| self.gross_error(*row).is_none())
    }

    /// Checks that not most of a channel cannot be what a wheel felt: then it is in other units than the format's.
    pub(super) fn check_units(&self) -> Result<(), HostError> {
        for channel in JUDGED {
            let all = self.column(channel.name()).unwrap_or(&[]).iter().flatten().count();
            let mut beyond =
                (0..self.rows().len()).filter_map(|row| Some((row, self.plausible.beyond(self, row, channel)?)));
            let Some((row, (value, limit))) = beyond.next() else { continue };
            let bad = 1 + beyond.count();
            if 2 * bad > all {
                let (name, unit) = (channel.name(), unit(channel));
                let or_load = if self.plausible.is_by_load(channel) { ", or load_n in newtons" } else { "" };
                let by_radius = match channel {
                    Channel::Sinkage | Channel::Torque => format!(" where radius_m is {} m", self.wheel.radius_m),
                    _ => String::new(),
                };
                return Err(self.error_at_row(
                    row,
                    channel,
                    format!(
                        "{name} of {value} {unit}, and {bad} of {all} values of it impossible (a load is above 0; here at most {limit:.3} {unit}{by_radius}): \
                         expected newtons, newton-metres and metres{or_load}",
                    ),
                ));
            }
        }
        self.check_medians()
    }

    /// The same of forces that a wheel may feel at times and never most of the time.
    fn check_medians(&self) -> Result<(), HostError> {
        for (channel, radius_m) in [(Channel::Torque, self.wheel.radius_m), (Channel::DrawbarPull, 1.0)] {
            let share = |row: usize| {
                let (slip, load_n) = (self.value(row, Channel::Slip)?, self.value(row, Channel::Load)?);
                let of_load = self.value(row, channel)?.abs() / (radius_m * load_n.abs());
                (slip > DRIVES && load_n != 0.0).then_some((row, of_load))
            };
            let shares: Vec<(usize, f64)> = (0..self.rows().len()).filter_map(share).collect();
            let middle = median(shares.iter().map(|(_, share)| *share));
            let beyond = shares.iter().find(|(_, share)| *share > GREATEST_MEDIAN_FORCE);
            let Some((row, _)) = beyond.filter(|_| shares.len() >= FEWEST && middle > GREATEST_MEDIAN_FORCE) else {
                continue;
            };
            let name = channel.name();
            let times = if channel == Channel::Torque { "load_n times radius_m" } else { "load_n" };
            let message = format!(
                "{name} is {middle:.1} times {times} in the middle of {} rows that drive, which no soil holds against (at most \
                 {GREATEST_MEDIAN_FORCE}): expected newtons, newton-metres and metres, or load_n in newtons",
                shares.len()
            );
            return Err(self.error_at_row(*row, channel, message));
        }
        Ok(())
    }
}

fn unit(channel: Channel) -> &'static str {
    match channel {
        Channel::Sinkage => "m",
        Channel::Torque => "N·m",
        _ => "N",
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn a_radius_in_other_units_is_named_beside_the_sinkage_that_it_forbids() {
        let toml = "name = \"small\"\nkind = \"simulated\"\nsource = \"\"\ngravity_m_s2 = 9.81\n[wheel]\nradius_m = 1e-9\n\
                    width_m = 0.1\n";
        let csv = "run,t_s,slip,load_n,sinkage_m\na,0,0.3,50,0.01\na,1,0.4,51,0.01\n";
        let said = Campaign::parse(Path::new("small.csv"), csv, toml).expect_err("no such wheel").to_string();
        assert!(said.contains("at most 0.000 m where radius_m is 0.000000001 m"), "{said}");
    }

    /// A load in kilograms, and a force at the rim in the torque's column: no single row is beyond what can be.
    #[test]
    fn forces_beyond_most_of_what_a_wheel_feels_are_in_other_units() {
        let toml = "name = \"small\"\nkind = \"measured\"\nsource = \"\"\n[wheel]\nradius_m = 0.1\nwidth_m = 0.1\n";
        let read = |load_n: f64, torque_nm: f64| {
            let row = |k: usize| format!("a,{k},0.3,{},{},{torque_nm}\n", load_n + 1e-3 * k as f64, 20.0 + k as f64);
            let rows: String = (0..6).map(row).collect();
            let csv = format!("run,t_s,slip,load_n,drawbar_pull_n,torque_nm\n{rows}");
            Campaign::parse(Path::new("small.csv"), &csv, toml).map_err(|error| error.to_string())
        };
        read(65.0, 2.0).expect("newtons");
        let said = read(6.63, 0.6).expect_err("kilograms");
        assert!(
            said.starts_with("small.csv:2:5: drawbar_pull_n is 3.4 times load_n in the middle of 6 rows"),
            "{said}"
        );
        let said = read(65.0, 20.0).expect_err("newtons at the rim");
        assert!(said.starts_with("small.csv:2:6: torque_nm is 3.1 times load_n times radius_m"), "{said}");
        assert!(said.ends_with("expected newtons, newton-metres and metres, or load_n in newtons"), "{said}");
    }
}
