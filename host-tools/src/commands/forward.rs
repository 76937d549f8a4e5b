//! `kapvik forward`: equations 1–11 over the rows of a table.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::{
    ForceError, SinkageError, Soil, Wheel, deepest_sinkage, greatest_load, sinkage_for_load, wheel_forces,
};

use crate::data::campaign::{Channel, nearly_named};
use crate::data::outputs;
use crate::data::soil_file::SoilTable;
use crate::data::table::{Column, Table};
use crate::data::wheel_file::WheelTable;
use crate::digits::significant;
use crate::error::HostError;

/// What to compute, and where the files are.
#[derive(Args)]
pub struct Arguments {
    /// The wheel: radius_m and width_m, bare or in a table [wheel] (rover files and campaigns have one)
    #[arg(long, value_name = "W.toml")]
    wheel: PathBuf,
    /// The soil: n, k_c and k_phi (or k_eff), c, phi (rad), K (m), c1, c2, eta, bare or in a table [soil]
    #[arg(long, value_name = "S.toml")]
    soil: PathBuf,
    /// Rows with slip and sinkage_m or load_n
    #[arg(value_name = "IN.csv")]
    input: PathBuf,
    /// Where the completed table goes
    #[arg(short, long, value_name = "OUT.csv")]
    output: PathBuf,
    /// The arithmetic: f64, or f32 as in flight (the same bits as on board)
    #[arg(long, value_enum, default_value = "f64")]
    precision: Precision,
}

#[derive(Clone, Copy, ValueEnum)]
enum Precision {
    F32,
    F64,
}

/// Completes the table.
///
/// # Errors
/// Where a file cannot be read or written, or does not hold what is expected: it names file, line and column.
pub fn execute(arguments: &Arguments) -> Result<(), HostError> {
    let Arguments { wheel, soil, output, .. } = arguments;
    outputs::check(&[Some(output)], &[Some(wheel), Some(soil)])?;
    let wheel = WheelTable::read(&arguments.wheel)?.wheel();
    let soil = SoilTable::read_complete(&arguments.soil)?;
    let mut table = Table::read(&arguments.input)?;
    match arguments.precision {
        Precision::F64 => Forward { wheel, soil, narrow: |value| value }.complete(&mut table)?,
        Precision::F32 => {
            let narrow = |value: f64| value as f32;
            Forward { wheel: wheel.map(narrow), soil: soil.map(narrow), narrow }.complete(&mut table)?;
        }
    }
    table.write(&arguments.output)
}

/// The equations in one precision.
struct Forward<S> {
    wheel: Wheel<S>,
    soil: Soil<S>,
    narrow: fn(f64) -> S,
}

/// The columns that the command reads and writes.
struct Columns {
    slip: Column,
    /// The one of `sinkage_m` and `load_n` that the table came with; `sinkage_m` where it came with both.
    asked: Column,
    drawbar_pull: Column,
    load: Column,
    torque: Column,
    sinkage: Column,
}

impl<S: Scalar> Forward<S> {
    fn complete(&self, table: &mut Table) -> Result<(), HostError> {
        let slip = one_of(table, &[Channel::Slip])?;
        let asked = one_of(table, &[Channel::Sinkage, Channel::Load])?;
        let [drawbar_pull, load, torque, sinkage] =
            ["drawbar_pull_n", "load_n", "torque_nm", "sinkage_m"].map(|name| table.column_or_append(name));
        let columns = Columns { slip, asked, drawbar_pull, load, torque, sinkage };
        (0..table.len()).try_for_each(|row| self.complete_row(table, &columns, row))
    }

    fn complete_row(&self, table: &mut Table, columns: &Columns, row: usize) -> Result<(), HostError> {
        let Some(slip) = table.number(row, columns.slip)? else {
            return Err(table.error_at(row, columns.slip, "empty: expected a slip from -1 to 1"));
        };
        let slip = (self.narrow)(slip);
        let (given_sinkage, given_load) = (table.number(row, columns.sinkage)?, table.number(row, columns.load)?);
        let sinkage = match (given_sinkage, given_load) {
            (Some(sinkage), _) => (self.narrow)(sinkage),
            (None, Some(load)) => self.sinkage(table, columns, row, slip, (self.narrow)(load))?,
            (None, None) => {
                return Err(table.error_at(
                    row,
                    columns.asked,
                    "empty: expected either sinkage_m or load_n in each row",
                ));
            }
        };
        let forces = wheel_forces(&self.wheel, &self.soil, slip, sinkage)
            .map_err(|error| self.force_error(table, columns, row, error))?;
        table.set(row, columns.drawbar_pull, written(forces.drawbar_pull_n));
        table.set(row, columns.torque, written(forces.torque_nm));
        match given_sinkage {
            Some(_) => table.set(row, columns.load, written(forces.load_n)),
            None => table.set(row, columns.sinkage, written(sinkage)),
        }
        Ok(())
    }

    /// The sinkage at which a row's load is carried.
    fn sinkage(&self, table: &Table, columns: &Columns, row: usize, slip: S, load: S) -> Result<S, HostError> {
        let found = sinkage_for_load(&self.wheel, &self.soil, slip, load);
        found.map_err(|error| match error {
            SinkageError::Input if load <= S::zero() => {
                table.error_at(row, columns.load, format!("{}: expected a load above 0 N", written(load)))
            }
            SinkageError::Input if slip.abs() <= S::one() => {
                self.force_error(table, columns, row, ForceError::Overflow)
            }
            SinkageError::Input => self.force_error(table, columns, row, ForceError::Slip),
            SinkageError::LoadTooGreat => table.error_at(row, columns.load, self.too_great(slip, load)),
        })
    }

    fn too_great(&self, slip: S, load: S) -> String {
        let deepest = rounded(deepest_sinkage(&self.wheel));
        let most = greatest_load(&self.wheel, &self.soil, slip);
        let carried =
            most.map_or_else(|_| "less".to_owned(), |most| format!("at most about {} N", rounded(most.load_n)));
        format!(
            "this soil does not carry {} N at slip {}: expected {carried} (down to a sinkage of {deepest} m)",
            written(load),
            written(slip)
        )
    }

    fn force_error(&self, table: &Table, columns: &Columns, row: usize, error: ForceError) -> HostError {
        let found = |column| table.text(row, column).trim().to_owned();
        match error {
            ForceError::Slip => {
                table.error_at(row, columns.slip, format!("{}: expected a slip from -1 to 1", found(columns.slip)))
            }
            ForceError::Sinkage => {
                let radius = written(self.wheel.radius_m);
                let message =
                    format!("{}: expected a sinkage from 0 m to the radius, {radius} m", found(columns.sinkage));
                table.error_at(row, columns.sinkage, message)
            }
            ForceError::Wheel | ForceError::Soil | ForceError::Overflow => table.error_at(
                row,
                columns.slip,
                "the forces are too great for this precision: expected a wheel and a soil of ordinary size",
            ),
        }
    }
}

/// The first of some columns that a table has, which the command cannot do without.
fn one_of(table: &Table, channels: &[Channel]) -> Result<Column, HostError> {
    let missing = || {
        let names: Vec<_> = channels.iter().map(|channel| channel.name()).collect();
        let missing = table.no_column(&names);
        let said: Vec<_> = std::iter::once(missing).chain(nearly_named(table.header(), channels.to_vec())).collect();
        table.error_in_header(said.join(". "))
    };
    channels.iter().find_map(|channel| table.column(channel.name())).ok_or_else(missing)
}

/// A number as a reader wants it.
fn rounded<S: Scalar>(value: S) -> f64 {
    significant(value.to_f32().into(), 4)
}

/// The shortest text that reads back as the same number.
fn written<S: Scalar>(value: S) -> String {
    format!("{value:?}")
}
