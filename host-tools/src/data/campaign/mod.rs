//! Wheel campaigns: `NAME.csv` with one row for a wheel at one time or over one window, `NAME.toml` with what is known
//! of wheel, soil and sensors.

mod about;
mod carried;
mod channel;
mod conditions;
mod copies;
mod declared;
mod fingerprint;
mod further_columns;
mod gross_error;
mod ground;
pub mod like_rows;
mod noise;
mod repeats;
mod saturated;
mod wrong_sign;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use kapvik_firmware::terramechanics::Wheel;

use crate::error::HostError;
use crate::printable::{on_one_line, paragraph};

use super::table::{Column, Table};
use super::text::TextFile;
use super::toml_file::TomlFile;
use super::wheel_file::Grousers;

use gross_error::Plausible;

pub use about::Provenance;
pub use carried::Carried;
pub use channel::Channel;
pub use declared::{Declared, DeclaredEffect, is_reference};
pub use fingerprint::Fingerprint;
pub use further_columns::nearly_named;
pub use ground::{Ground, Knowledge};
pub use noise::ChannelNoise;

/// A campaign: rows of measurements, and what is known about them.
#[derive(Debug, Clone)]
pub struct Campaign {
    /// The table of the measurements.
    pub path: PathBuf,
    /// Its name in reports.
    pub name: String,
    /// Where the numbers come from.
    pub provenance: Provenance,
    /// Citation and licence.
    pub source: String,
    /// What a reader of its results should know, sentence by sentence.
    pub notes: Vec<String>,
    /// Gravity at the place of the test, m/s².
    pub gravity_m_s2: f64,
    /// The geometry of the wheel.
    pub wheel: Wheel<f64>,
    /// Its grousers, which act only through an effect.
    pub grousers: Grousers,
    /// What is known of the soil by other means.
    pub ground: Ground,
    /// What is stated about the sensors.
    pub noise: ChannelNoise,
    /// The effects that the model is told of.
    pub declared: Declared,
    header: Vec<String>,
    header_line: u64,
    rows: Vec<RowId>,
    columns: Vec<Measured>,
    repeats: usize,
    saturated: Vec<saturated::End>,
    copies: Vec<bool>,
    plausible: Plausible,
}

/// Which wheel state a row is.
#[derive(Debug, Clone, PartialEq)]
pub struct RowId {
    /// The run: rows of one run are correlated, and lie on one soil.
    pub run: String,
    /// The run that the file has the row in.
    pub run_in_file: String,
    /// Time within the run, s.
    pub t_s: f64,
    /// Line of the file, from 1.
    pub line: u64,
}

/// One column of numbers.
#[derive(Debug, Clone)]
struct Measured {
    name: String,
    values: Vec<Option<f64>>,
}

impl Campaign {
    /// Reads `NAME.csv` and the `NAME.toml` beside it.
    ///
    /// # Errors
    /// At the file, line and column of the first thing that is not as it should be.
    pub fn read(path: &Path) -> Result<Self, HostError> {
        let table = Table::read(path)?;
        Self::assemble(path, &table, &TomlFile::read(&about_path(path)?)?)
    }

    /// A campaign from the texts of its two files, under the name `path`.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(path: &Path, csv: &str, toml: &str) -> Result<Self, HostError> {
        let table = Table::parse(&TextFile::new(path, csv))?;
        Self::assemble(path, &table, &TomlFile::new(TextFile::new(&path.with_extension("toml"), toml)))
    }

    /// The measured figures that the project carries for its own reports: a smooth wheel at six slips on a soil that
    /// direct tests know.
    ///
    /// # Errors
    /// Never in practice: the figures are part of this program, and tested.
    pub fn carried() -> Result<Self, HostError> {
        Carried::Ding2011Smooth.campaign()
    }

    fn assemble(path: &Path, table: &Table, toml: &TomlFile) -> Result<Self, HostError> {
        let (about, unused) = about::About::read(toml)?;
        let mut rows = row_ids(table)?;
        let mut columns = numeric_columns(table)?;
        let repeats = repeats::take_out(&mut rows, &mut columns);
        let saturated = saturated::take_out(&rows, &mut columns);
        let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
        let mut campaign = Self {
            path: path.to_path_buf(),
            wheel: about.wheel.wheel(),
            grousers: about.wheel.grousers(),
            ground: Ground::read(&about.soil, toml)?,
            noise: ChannelNoise::read(&about.noise, toml, &names)?,
            declared: Declared::read(about.declared, toml)?,
            name: paragraph(&about.name),
            provenance: about.kind,
            source: paragraph(&about.source),
            notes: Vec::from(about.notes).iter().map(|note: &String| paragraph(note)).collect(),
            gravity_m_s2: about.gravity_m_s2.into_inner(),
            header: table.header().to_vec(),
            header_line: table.header_line(),
            rows,
            columns,
            repeats,
            saturated,
            copies: Vec::new(),
            plausible: Plausible::unknown(),
        };
        if campaign.rows.is_empty() {
            return Err(table.error_in_header("no rows below the header: expected one for each wheel and time"));
        }
        campaign.plausible = Plausible::of(&campaign);
        campaign.copies = campaign.find_copies();
        campaign.check_units()?;
        campaign.check_signs()?;
        unused.tell();
        Ok(campaign)
    }

    /// What a reader of any result should know of how the file was read, sentence by sentence.
    pub fn remarks(&self) -> Vec<String> {
        let of_rows = self.of_repeats().into_iter().chain(self.saturated.iter().map(saturated::End::in_words));
        let of_numbers = of_rows.chain(self.of_falling_pull()).chain(self.ground.of_unused());
        of_numbers.chain(further_columns::misspelt(&self.header)).collect()
    }

    /// What is said where rows of the file were taken out that only repeat what the sensors had said before.
    fn of_repeats(&self) -> Option<String> {
        (self.repeats > 0).then(|| {
            format!(
                "{} rows say in every channel of the wheel's sensors what the same wheel said an instant before: the logger writes \
                 faster than the sensors speak. They are no new readings, and are left out.",
                self.repeats
            )
        })
    }

    /// The rows, in the order of the file; without those that repeat an instant before, where there are many.
    pub fn rows(&self) -> &[RowId] {
        &self.rows
    }

    /// The runs, in the order in which they first come, each with the places of its rows.
    pub fn runs(&self) -> Vec<(&str, Vec<usize>)> {
        let mut runs: Vec<(&str, Vec<usize>)> = Vec::new();
        let mut places = std::collections::HashMap::new();
        for (row, id) in self.rows.iter().enumerate() {
            let place = *places.entry(id.run.as_str()).or_insert_with(|| {
                runs.push((&id.run, Vec::new()));
                runs.len() - 1
            });
            runs[place].1.push(row);
        }
        runs
    }

    /// Whether the file has more than one run.
    pub fn has_several_runs(&self) -> bool {
        self.rows.windows(2).any(|pair| pair[0].run_in_file != pair[1].run_in_file)
    }

    /// The same with every row a run of its own, named after its run and its place from 1: for tests that were done one after
    /// the other and stand in one run of the file.
    #[must_use]
    pub fn with_a_run_for_each_row(mut self) -> Self {
        for (row, id) in self.rows.iter_mut().enumerate() {
            id.run = format!("{}-{}", id.run, row + 1);
        }
        self
    }

    /// The same as one sees it who knows effects, or who knows none and so is told of none.
    pub fn as_seen(&self, knows_effects: bool) -> Cow<'_, Self> {
        if knows_effects {
            Cow::Borrowed(self)
        } else {
            Cow::Owned(Self { declared: Declared::default(), ..self.clone() })
        }
    }

    /// The names of the columns of numbers, `t_s` aside.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|column| column.name.as_str())
    }

    /// The column of that name, a number or nothing for each row; none where the file has no such column of numbers.
    pub fn column(&self, name: &str) -> Option<&[Option<f64>]> {
        self.columns.iter().find(|column| column.name == name).map(|column| column.values.as_slice())
    }

    /// What a row has in a channel.
    pub fn value(&self, row: usize, channel: Channel) -> Option<f64> {
        self.column(channel.name())?.get(row).copied().flatten()
    }

    /// An error about what a row has in a channel: at the row's line and the channel's column.
    pub fn error_at_row(&self, row: usize, channel: Channel, message: impl Into<String>) -> HostError {
        let line = self.rows.get(row).map_or(1, |id| id.line);
        let column = self.header.iter().position(|name| name == channel.name()).map_or(1, |place| place as u64 + 1);
        HostError::Input { path: self.path.clone(), line, column, message: message.into() }
    }

    /// An error about a column that the table lacks; columns that may be meant are named beside.
    pub fn error(&self, message: impl Into<String>) -> HostError {
        let said: Vec<_> = std::iter::once(message.into()).chain(further_columns::misspelt(&self.header)).collect();
        HostError::Input { path: self.path.clone(), line: self.header_line, column: 1, message: said.join(". ") }
    }
}

/// `NAME.toml` for `NAME.csv`.
fn about_path(path: &Path) -> Result<PathBuf, HostError> {
    let about = path.with_extension("toml");
    if about == path {
        return Err(HostError::Failed(format!("{}: expected the table NAME.csv of a campaign", path.display())));
    }
    if about.is_file() {
        return Ok(about);
    }
    Err(HostError::Failed(format!(
        "{}: no such file: expected it beside {}, with the wheel, the soil and the noise of the campaign",
        about.display(),
        path.display()
    )))
}

fn row_ids(table: &Table) -> Result<Vec<RowId>, HostError> {
    let (run, t_s) = (table.required_column("run")?, table.required_column(Channel::Time.name())?);
    let id = |row| {
        let name = table.text(row, run).trim();
        if name.is_empty() {
            return Err(table.error_at(row, run, "nothing here: expected the name of the run"));
        }
        let t_s = table.number(row, t_s)?.ok_or_else(|| {
            table.error_at(row, t_s, "nothing here: expected the time in s, 0 for the mean over a window")
        })?;
        let run = on_one_line(name).to_string();
        Ok(RowId { run_in_file: run.clone(), run, t_s, line: table.line(row) })
    };
    (0..table.len()).map(id).collect()
}

/// Every column of numbers. One that the format does not name may also hold text, and is then left out.
fn numeric_columns(table: &Table) -> Result<Vec<Measured>, HostError> {
    let mut columns = Vec::new();
    for name in table.header().iter().filter(|name| !["run", Channel::Time.name()].contains(&name.as_str())) {
        let column = table.required_column(name)?;
        let channel = Channel::from_name(name);
        if channel.is_none() && is_text(table, column) {
            continue;
        }
        let value = |row| {
            let value = table.number(row, column)?;
            if let (Some(channel), Some(number)) = (channel, value) {
                channel.check(number).map_err(|expected| {
                    table.error_at(row, column, format!("`{}`: expected {expected}", table.text(row, column).trim()))
                })?;
            }
            Ok(value)
        };
        let values = (0..table.len()).map(value).collect::<Result<_, HostError>>()?;
        columns.push(Measured { name: name.clone(), values });
    }
    Ok(columns)
}

/// Whether more fields of the column are text than are numbers: a remark may be `3`, and a slip of the pen in a column of numbers is an error.
fn is_text(table: &Table, column: Column) -> bool {
    let fields = (0..table.len()).map(|row| table.text(row, column).trim()).filter(|text| !text.is_empty());
    let (numbers, texts): (Vec<&str>, Vec<&str>) = fields.partition(|text| text.parse::<f64>().is_ok());
    texts.len() > numbers.len()
}
