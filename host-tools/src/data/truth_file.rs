//! What is true of a simulated drive, in CSV, row by row beside its sensor frames.

use std::io::Write;
use std::path::{Path, PathBuf};

use kapvik_firmware::rover::PerWheel;

use super::misspelling::refuse_misspelt;
use super::number_stream::{NumberStream, Row};
use super::sensor_channels::WHEEL_NAMES;
use super::time_column::{self, TimeColumn};
use crate::error::HostError;
use crate::wheel_quantity::WheelQuantity;

/// The soil at one place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TrueSoil {
    /// Cohesion c, Pa.
    pub cohesion_pa: f64,
    /// Friction angle φ, rad.
    pub friction_angle_rad: f64,
    /// Shear deformation modulus K, m.
    pub shear_modulus_m: f64,
    /// Stiffness k_c/b + k_φ under the rover's wheel, Pa/mⁿ.
    pub stiffness_pa_m_n: f64,
    /// Sinkage exponent n.
    pub sinkage_exponent: f64,
}

/// What is true of one wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelTruth {
    /// Slip i, −1 … 1, positive when driving in either direction; none where the wheel stands.
    pub slip: Option<f64>,
    /// Torque with which the soil resists, N·m.
    pub resistive_torque_nm: f64,
    /// Slope of the terrain under the hub against the horizontal, in the wheel's plane, rad, uphill.
    pub contact_angle_rad: f64,
    /// Normal load W, N.
    pub normal_load_n: f64,
    /// Drawbar pull DP, N.
    pub drawbar_pull_n: f64,
    /// Sinkage z, m; 0 where the wheel is in the air.
    pub sinkage_m: f64,
    /// Force of the soil along the axle, N, to the left.
    pub side_force_n: f64,
    /// The soil under its hub.
    pub soil: TrueSoil,
}

/// What is true at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Truth {
    /// Time, µs.
    pub time_us: u64,
    /// The wheels.
    pub wheels: PerWheel<WheelTruth>,
    /// The soil under the differential axis.
    pub soil: TrueSoil,
    /// x of the midpoint of the differential axis, m.
    pub x_m: f64,
    /// Its height, m.
    pub z_m: f64,
    /// Pitch of the body, nose-up, rad.
    pub pitch_rad: f64,
    /// Roll of the body, left side up, rad.
    pub roll_rad: f64,
}

/// Where the truth of a file of frames is written: NAME.truth.csv beside NAME.csv, or beside a NAME of any other kind.
pub fn truth_path(frames: &Path) -> PathBuf {
    let is_table = frames.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
    // Of `drive.1` the 1 belongs to the name: `drive.2` has a truth of its own.
    if is_table { frames.with_extension("truth.csv") } else { frames.with_added_extension("truth.csv") }
}

/// Names of the columns, in the order of [`values`].
fn names() -> Vec<String> {
    let wheel = |wheel: &str| {
        let estimated = WheelQuantity::ALL.map(WheelQuantity::column);
        let quantities = estimated.into_iter().chain([("sinkage_", "_m"), ("side_force_", "_n")]);
        let quantities = quantities.map(|(before, behind)| format!("{before}{wheel}{behind}"));
        quantities.chain(soil_names().map(|name| format!("{name}_{wheel}"))).collect::<Vec<_>>()
    };
    let body = ["x_m", "z_m", "pitch_rad", "roll_rad"].map(str::to_owned);
    WHEEL_NAMES.into_iter().flat_map(wheel).chain(soil_names().map(str::to_owned)).chain(body).collect()
}

fn soil_names() -> [&'static str; 5] {
    ["cohesion_pa", "friction_angle_rad", "shear_modulus_m", "stiffness_pa_m_n", "sinkage_exponent"]
}

fn soil_values(soil: &TrueSoil) -> [Option<f64>; 5] {
    let TrueSoil { cohesion_pa, friction_angle_rad, shear_modulus_m, stiffness_pa_m_n, sinkage_exponent } = *soil;
    [cohesion_pa, friction_angle_rad, shear_modulus_m, stiffness_pa_m_n, sinkage_exponent].map(Some)
}

/// The values of a row, in the order of [`names`].
fn values(truth: &Truth) -> Vec<Option<f64>> {
    let wheel = |wheel: &WheelTruth| {
        let estimated = WheelQuantity::ALL.map(|quantity| quantity.truth(wheel));
        let further = [wheel.sinkage_m, wheel.side_force_n].map(Some);
        estimated.into_iter().chain(further).chain(soil_values(&wheel.soil)).collect::<Vec<_>>()
    };
    let body = [truth.x_m, truth.z_m, truth.pitch_rad, truth.roll_rad].map(Some);
    truth.wheels.iter_wheels().flat_map(wheel).chain(soil_values(&truth.soil)).chain(body).collect()
}

/// The next values of a row, in the order of [`names`]; a missing one is NaN.
struct Values<I>(I);

impl<I: Iterator<Item = Option<f64>>> Values<I> {
    fn next(&mut self) -> f64 {
        self.0.next().flatten().unwrap_or(f64::NAN)
    }

    fn soil(&mut self) -> TrueSoil {
        TrueSoil {
            cohesion_pa: self.next(),
            friction_angle_rad: self.next(),
            shear_modulus_m: self.next(),
            stiffness_pa_m_n: self.next(),
            sinkage_exponent: self.next(),
        }
    }

    fn wheel(&mut self) -> WheelTruth {
        WheelTruth {
            slip: self.0.next().flatten(),
            resistive_torque_nm: self.next(),
            contact_angle_rad: self.next(),
            normal_load_n: self.next(),
            drawbar_pull_n: self.next(),
            sinkage_m: self.next(),
            side_force_n: self.next(),
            soil: self.soil(),
        }
    }

    fn truth(mut self, time_us: u64) -> Truth {
        Truth {
            time_us,
            wheels: PerWheel::<()>::default().map_wheels(|()| self.wheel()),
            soil: self.soil(),
            x_m: self.next(),
            z_m: self.next(),
            pitch_rad: self.next(),
            roll_rad: self.next(),
        }
    }
}

/// Writes the header of a file of truths.
///
/// # Errors
/// Those of `out`.
pub fn write_header(out: &mut dyn Write) -> std::io::Result<()> {
    time_column::write_header(out, &names())
}

/// Writes a truth as a row, each number in as many digits as lead back to it.
///
/// # Errors
/// Those of `out`.
pub fn write_truth(out: &mut dyn Write, truth: &Truth) -> std::io::Result<()> {
    time_column::write_row(out, truth.time_us, values(truth).into_iter())
}

/// The truths of a file, row by row. Beside `t_s` each column may be missing; what is not there is NaN.
pub struct TruthReader {
    stream: NumberStream,
    time: TimeColumn,
    columns: Vec<Option<usize>>,
}

impl TruthReader {
    /// Opens a file of truths.
    ///
    /// # Errors
    /// Where it cannot be read, or its header has no time, nothing that is true, or a column that is nearly one.
    pub fn open(path: &Path) -> Result<Self, HostError> {
        let stream = NumberStream::open(path)?;
        let time = TimeColumn::of(&stream)?;
        let names = names();
        refuse_misspelt(&stream, &names, "column of a truth")?;
        let columns: Vec<_> = names.iter().map(|name| stream.column(name)).collect();
        if columns.iter().all(Option::is_none) {
            let expected = format!("no column of a truth beside `t_s`: expected some of {}, …", names[..7].join(", "));
            return Err(stream.error_in_header(1, expected));
        }
        Ok(Self { stream, time, columns })
    }

    fn truth(&mut self, row: &Row) -> Result<Truth, HostError> {
        let time_us = self.time.next(&self.stream, row)?;
        let number = |column: &Option<usize>| column.map_or(Ok(None), |column| self.stream.number(row, column));
        let values = self.columns.iter().map(number).collect::<Result<Vec<_>, _>>()?;
        Ok(Values(values.into_iter()).truth(time_us))
    }
}

impl Iterator for TruthReader {
    type Item = Result<Truth, HostError>;
    fn next(&mut self) -> Option<Self::Item> {
        let row = self.stream.next_row().transpose()?;
        Some(row.and_then(|row| self.truth(&row)))
    }
}
