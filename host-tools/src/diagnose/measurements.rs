//! The rows of a campaign that a diagnosis can use.

use std::collections::HashMap;

use kapvik_firmware::terramechanics::effects::{Conditions, speed_ratio};

use crate::data::campaign::{Campaign, Channel};
use crate::error::HostError;
use crate::statistics;

use super::chance::of_known_noise;
use super::document::LeftOut;
use super::fit::{CHANNELS, Reading, Row};
use super::lone_rows::LoneRow;
use super::loose_slip::loose_slip;
use super::noise::{Noise, channel_noise};
use super::rates::wheel_rates;
use super::settings::{Settled, settle};
use super::thinning::{some_runs, thinned};
use super::usable_rows::{UsableRow, usable_rows};

/// The column of each reading, in the order of [`Reading::ALL`].
pub const COLUMNS: [Channel; CHANNELS] =
    [Channel::DrawbarPull, Channel::Torque, Channel::Sinkage, Channel::SideForce, Channel::Slip, Channel::Load];

/// Share of the rows that must have a column for something to be said to follow it.
pub const KNOWN_SHARE: f64 = 0.8;
/// Times the stated noise from which runs are far off; and the chance below which that noise does not make the means of runs scatter so.
const OFF: f64 = 1.0;
const CHANCE: f64 = 1e-3;

/// The name of a reading's column.
pub fn column_name(reading: Reading) -> &'static str {
    COLUMNS[reading.index()].name()
}

/// What a campaign measured, row by row.
#[derive(Debug, Clone)]
pub struct Measurements {
    /// The rows, those of a run in the order of its time.
    pub rows: Vec<Row>,
    /// Place of each row in the campaign.
    pub places: Vec<usize>,
    /// What else is known of each row. Where the wheel rate is known, the speed follows from it and the true slip.
    pub conditions: Vec<Conditions<f64>>,
    /// Names of the runs, by their number.
    pub runs: Vec<String>,
    /// Rows of each run.
    pub rows_of_run: Vec<Vec<usize>>,
    /// The noise of each reading.
    pub noise: [Noise; CHANNELS],
    /// What slips scatter by about a sweep, where that is more than is taken for their noise.
    pub loose_slip: Option<f64>,
    /// Rows that were left out.
    pub left_out: Vec<LeftOut>,
    /// Which rows were held at one slip or load.
    pub settled: Settled,
    /// Whether the load is the same number in every row: what was put on the wheel, and no reading of a sensor.
    pub is_load_set: bool,
    /// Radius of the wheel, m.
    radius_m: f64,
}

impl Measurements {
    /// The rows that drive, or all of them.
    ///
    /// # Errors
    /// Where the campaign lacks a column without which nothing can be said, or no row is left.
    pub fn of(campaign: &Campaign, braking: bool) -> Result<Self, HostError> {
        Self::without(campaign, braking, &[])
    }

    /// The same without some rows, by their places in the campaign.
    ///
    /// # Errors
    /// As of [`Measurements::of`].
    pub fn without(campaign: &Campaign, braking: bool, lone: &[LoneRow]) -> Result<Self, HostError> {
        check_columns(campaign)?;
        let (usable, left_out) = usable_rows(campaign, braking, lone)?;
        Ok(Self::in_runs(campaign, &usable, left_out))
    }

    fn in_runs(campaign: &Campaign, usable: &[UsableRow], left_out: Vec<LeftOut>) -> Self {
        let noise = channel_noise(campaign, usable);
        let loads = || usable.iter().filter_map(|row| row.readings[Reading::Load.index()]);
        let mut found = Self {
            rows: Vec::new(),
            places: Vec::new(),
            conditions: Vec::new(),
            runs: Vec::new(),
            rows_of_run: Vec::new(),
            noise,
            loose_slip: loose_slip(campaign, usable),
            left_out,
            settled: Settled::default(),
            is_load_set: loads().next().is_some() && !varies(loads()),
            radius_m: campaign.wheel.radius_m,
        };
        let by_place: HashMap<usize, &UsableRow> = usable.iter().map(|row| (row.place, row)).collect();
        let runs = runs_in_time(campaign, &by_place);
        let runs = some_runs(&runs);
        let rows = runs.iter().map(|(_, places)| places.len()).sum();
        for (number, (name, places)) in runs.into_iter().enumerate() {
            let mut of_run = Vec::new();
            for place in thinned(places, rows, number) {
                let readings = by_place[&place].readings;
                of_run.push(found.rows.len());
                found.places.push(place);
                found.conditions.push(campaign.conditions(place));
                found.rows.push(Row { run: found.runs.len(), readings, noise: noise.map(|noise| noise.std) });
            }
            found.runs.push((*name).to_owned());
            found.rows_of_run.push(of_run);
        }
        if found.rows.len() < usable.len() {
            let reason = "thinned evenly, to keep within seconds".to_owned();
            found.left_out.push(LeftOut { reason, rows: usable.len() - found.rows.len() });
        }
        found.take_wheel_rates(campaign);
        found.settled = settle(&mut found.rows, &found.rows_of_run);
        found
    }

    /// Where the rate of the wheel is known, the speed follows from it.
    fn take_wheel_rates(&mut self, campaign: &Campaign) {
        let rates = wheel_rates(campaign, &self.places, &self.rows, &self.rows_of_run);
        for (conditions, rate_rad_s) in self.conditions.iter_mut().zip(rates) {
            if rate_rad_s.is_some() {
                conditions.wheel_rate_rad_s = rate_rad_s;
                conditions.speed_m_s = None;
            }
        }
    }

    /// Radius of the wheel, m.
    pub fn radius_m(&self) -> f64 {
        self.radius_m
    }

    /// Whether any row has the reading.
    pub fn has(&self, reading: Reading) -> bool {
        self.rows.iter().any(|row| row.readings[reading.index()].is_some())
    }

    /// The channels in which runs are each off by far more than the stated noise, and by how many times it, where run offsets scatter so.
    pub fn off_by_run(&self, offset_std: &[f64; CHANNELS]) -> impl Iterator<Item = (Reading, f64)> {
        let judged =
            Reading::JUDGED.into_iter().filter(|reading| self.noise[reading.index()].stated && self.has(*reading));
        let times = |reading: Reading| (reading, offset_std[reading.index()] / self.noise[reading.index()].std);
        let is_off = |(reading, times): &(Reading, f64)| {
            let channel = reading.index();
            let rows = |run: &Vec<usize>| run.iter().filter(|row| self.rows[**row].readings[channel].is_some()).count();
            let rows: Vec<f64> =
                self.rows_of_run.iter().map(rows).filter(|rows| *rows > 0).map(|rows| rows as f64).collect();
            let squares: f64 = rows.iter().map(|rows| 1.0 + rows * times * times).sum();
            *times > OFF && of_known_noise(squares, rows.len() as f64) < CHANCE
        };
        judged.map(times).filter(is_off)
    }

    /// The slips of a run.
    pub fn slips(&self, run: usize) -> impl Iterator<Item = f64> {
        self.rows_of_run[run].iter().filter_map(|row| self.rows[*row].readings[Reading::Slip.index()])
    }

    /// Mean slip of a run; every row that is used has one.
    pub fn mean_slip(&self, run: usize) -> f64 {
        self.slips(run).sum::<f64>() / self.slips(run).count() as f64
    }

    /// r ω of each row, m/s, where the rate is known.
    pub fn rim_speeds_m_s(&self) -> impl Iterator<Item = Option<f64>> {
        self.conditions.iter().map(|row| row.wheel_rate_rad_s.map(|rate| rate * self.radius_m))
    }

    /// Speed of each row where it is known, m/s.
    pub fn speeds_m_s(&self) -> impl Iterator<Item = Option<f64>> {
        let rows = self.rim_speeds_m_s().zip(&self.conditions).zip(&self.rows);
        rows.map(|((rim, conditions), row)| {
            let followed = || Some(rim? * speed_ratio(row.readings[Reading::Slip.index()]?));
            conditions.speed_m_s.or_else(followed)
        })
    }

    /// The middle one of a reading's values.
    pub fn median(&self, reading: Reading) -> Option<f64> {
        median(self.rows.iter().filter_map(|row| row.readings[reading.index()]).collect())
    }
}

/// The usable rows of each run that has any, by their places, in the order of time.
fn runs_in_time<'a>(campaign: &'a Campaign, usable: &HashMap<usize, &UsableRow>) -> Vec<(&'a str, Vec<usize>)> {
    let mut runs = campaign.runs();
    for (_, places) in &mut runs {
        places.retain(|place| usable.contains_key(place));
        places.sort_by(|a, b| campaign.rows()[*a].t_s.total_cmp(&campaign.rows()[*b].t_s));
    }
    runs.retain(|(_, places)| !places.is_empty());
    runs
}

/// The middle of some numbers; none of none.
pub fn median(values: Vec<f64>) -> Option<f64> {
    (!values.is_empty()).then(|| statistics::median(values))
}

/// Whether some numbers differ by more than their rounding.
pub fn varies(values: impl Iterator<Item = f64>) -> bool {
    statistics::ends(values).is_some_and(|(low, high)| high - low > 1e-6 * (low.abs() + high.abs()))
}

fn check_columns(campaign: &Campaign) -> Result<(), HostError> {
    let has =
        |channel: Channel| campaign.column(channel.name()).is_some_and(|column| column.iter().any(Option::is_some));
    if !has(Channel::Slip) {
        return Err(campaign.error("no column `slip` with a number: without slip no model predicts a force"));
    }
    if !has(Channel::Load) && !has(Channel::Sinkage) {
        return Err(campaign.error("neither `load_n` nor `sinkage_m`: expected at least one of them"));
    }
    let judged = [Channel::DrawbarPull, Channel::Torque, Channel::Sinkage, Channel::SideForce];
    let others = judged.into_iter().filter(|channel| has(*channel)).count();
    let alone = others == 1 && has(Channel::Sinkage) && !has(Channel::Load);
    if others == 0 || alone {
        return Err(
            campaign.error("nothing to judge: expected `drawbar_pull_n`, `torque_nm` or, beside a load, `sinkage_m`")
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn rows_that_brake_are_used_where_no_other_is_left() {
        let toml = "name = \"skid\"\nkind = \"simulated\"\nsource = \"\"\ngravity_m_s2 = 9.81\n[wheel]\nradius_m = 0.1\n\
                    width_m = 0.1\n";
        let csv = "run,t_s,slip,load_n,drawbar_pull_n\na,0,-0.3,50,-20\na,1,-0.4,51,-22\n";
        let rows = |csv: &str, braking: bool| {
            let campaign = Campaign::parse(Path::new("skid.csv"), csv, toml).expect("a campaign");
            let found = Measurements::of(&campaign, braking).expect("rows");
            (found.rows.len(), found.left_out.iter().map(|left_out| left_out.rows).sum())
        };
        assert_eq!(rows(csv, false), (2, 0));
        let with_one_that_drives = format!("{csv}a,2,0.3,52,9\n");
        assert_eq!([false, true].map(|braking| rows(&with_one_that_drives, braking)), [(1, 2), (3, 0)]);
    }
}
