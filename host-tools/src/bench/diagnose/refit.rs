//! How much of an effect is left when the declared model has been fitted anew: to first order about the truth, so that it
//! is cheap, and has nothing in common with the fit that is put to the test.

use kapvik_firmware::terramechanics::Soil;
use nalgebra::{Cholesky, Const, Matrix4, SMatrix, SVector, Vector4};

use super::instruments::Instruments;
use super::layout::Layout;
use super::site::Site;
use super::state::{LOAD, Row, SLIP, State};
use super::world::Undeclared;

/// ln c, φ, ln K, n, ln k, c₁ and c₂.
const SOIL: usize = 7;
/// Channels that the soil answers in: those of a state before slip and load.
const ANSWERS: usize = 4;

type Slopes = SMatrix<f64, ANSWERS, SOIL>;

/// One standard deviation of what is known of the seven parameters before the campaign; the common prior of those that
/// its file does not name.
pub const PRIOR_STD: [f64; SOIL] = [1.2, 0.105, 0.6, 0.3, 0.9, 0.15, 0.15];

/// A refit of the declared model to a campaign, linearised.
pub struct Refit {
    clean: Vec<State>,
    rows: Vec<LinearRow>,
    information: Cholesky<f64, Const<SOIL>>,
}

/// A row about its true soil, slip and load.
struct LinearRow {
    by_soil: Slopes,
    by_slip: Vector4<f64>,
    by_load: Vector4<f64>,
    /// Inverse covariance of what is measured beside slip and load, with what their errors add.
    weight: Matrix4<f64>,
    /// One standard deviation of each channel, likewise; none where it is not measured.
    std: [Option<f64>; ANSWERS],
}

impl Refit {
    /// The refit of a campaign; none where one of its rows is impossible.
    pub fn new(site: &Site, layout: &Layout, instruments: &Instruments, prior_std: &[f64; SOIL]) -> Option<Self> {
        let nothing = Undeclared::nothing();
        let clean = nothing.readings(site, &layout.rows)?;
        let slopes = Neighbours::new(site, &layout.rows, &clean)?;
        let rows: Vec<LinearRow> =
            (0..clean.len()).map(|place| slopes.row(place, instruments)).collect::<Option<_>>()?;
        let mut information =
            SMatrix::<f64, SOIL, SOIL>::from_diagonal(&SVector::from(*prior_std).map(|std| std.powi(-2)));
        for row in &rows {
            information += row.by_soil.transpose() * row.weight * row.by_soil;
        }
        Some(Self { clean, rows, information: Cholesky::new(information)? })
    }

    /// What of the readings of an effect no refit can explain: in each row and channel, in units of the noise there, that
    /// of slip and load included.
    pub fn residual(&self, readings: &[State]) -> Residual {
        let shifts: Vec<Vector4<f64>> = self.shifts(readings).collect();
        let mut gradient = SVector::<f64, SOIL>::zeros();
        for (row, shift) in self.rows.iter().zip(&shifts) {
            gradient += row.by_soil.transpose() * row.weight * shift;
        }
        let soil = self.information.solve(&gradient);
        let left = self.rows.iter().zip(&shifts).map(|(row, shift)| {
            let left = shift - row.by_soil * soil;
            std::array::from_fn(|channel| row.std[channel].map_or(0.0, |std| left[channel] / std))
        });
        Residual(left.collect())
    }

    /// How far the effect moves each row, once its slip and load are taken as they are read.
    fn shifts(&self, readings: &[State]) -> impl Iterator<Item = Vector4<f64>> {
        self.rows.iter().zip(self.clean.iter().zip(readings)).map(|(row, (clean, reading))| {
            let (clean, reading) = (clean.channels(), reading.channels());
            let direct = Vector4::from_fn(|channel, _| reading[channel] - clean[channel]);
            direct - row.by_slip * (reading[SLIP] - clean[SLIP]) - row.by_load * (reading[LOAD] - clean[LOAD])
        })
    }
}

/// What a refit leaves, row by row, in units of the noise.
pub struct Residual(Vec<[f64; ANSWERS]>);

impl Residual {
    /// The root mean square of the channel where most is left.
    pub fn size(&self) -> f64 {
        let mean_square = |channel: usize| {
            self.0.iter().map(|row| row[channel] * row[channel]).sum::<f64>() / self.0.len().max(1) as f64
        };
        libm::sqrt((0..ANSWERS).map(mean_square).fold(0.0, f64::max))
    }

    /// What is left of this residual beside a multiple of another.
    pub fn beside(&self, other: &Self) -> Self {
        let product =
            |a: &Self, b: &Self| -> f64 { a.0.iter().flatten().zip(b.0.iter().flatten()).map(|(a, b)| a * b).sum() };
        let multiple = product(self, other) / product(other, other).max(f64::MIN_POSITIVE);
        let rows = self.0.iter().zip(&other.0);
        Self(rows.map(|(row, other)| std::array::from_fn(|k| row[k] - multiple * other[k])).collect())
    }
}

/// The readings without effect, and those at soils, slips and loads a little further.
struct Neighbours<'a> {
    clean: &'a [State],
    soils: Vec<(f64, Vec<State>)>,
    slip: (f64, Vec<State>),
    load: (f64, Vec<State>),
}

impl<'a> Neighbours<'a> {
    fn new(site: &Site, rows: &[Row], clean: &'a [State]) -> Option<Self> {
        let nothing = Undeclared::nothing();
        const STEP: f64 = 1e-4;
        let soils = (0..SOIL)
            .map(|axis| {
                let beside = Site { soil: stepped(&site.soil, axis, STEP), ..site.clone() };
                Some((STEP, nothing.readings(&beside, rows)?))
            })
            .collect::<Option<_>>()?;
        let load_step_n = STEP * site.load_n;
        let moved = |change: fn(&mut Row, f64), step: f64| {
            let mut rows = rows.to_vec();
            rows.iter_mut().for_each(|row| change(row, step));
            Some((step, nothing.readings(site, &rows)?))
        };
        Some(Self {
            clean,
            soils,
            slip: moved(|row, step| row.slip += step, STEP)?,
            load: moved(|row, step| row.load_n += step, load_step_n)?,
        })
    }

    fn slope(&self, place: usize, further: &(f64, Vec<State>)) -> Vector4<f64> {
        let (from, to) = (self.clean[place].channels(), further.1[place].channels());
        Vector4::from_fn(|channel, _| (to[channel] - from[channel]) / further.0)
    }

    fn row(&self, place: usize, instruments: &Instruments) -> Option<LinearRow> {
        let columns: Vec<Vector4<f64>> = self.soils.iter().map(|soil| self.slope(place, soil)).collect();
        let (by_slip, by_load) = (self.slope(place, &self.slip), self.slope(place, &self.load));
        let std_of = |channel: usize| instruments.noise[channel].unwrap_or(0.0);
        let brought =
            by_slip * by_slip.transpose() * std_of(SLIP).powi(2) + by_load * by_load.transpose() * std_of(LOAD).powi(2);
        // A channel that is not measured has no weight.
        let own = |channel: usize| {
            let std = instruments.noise[channel].map_or(1e9, |std| std.hypot(instruments.offset_std[channel]));
            std * std
        };
        let covariance = brought + Matrix4::from_diagonal(&Vector4::from_fn(|channel, _| own(channel)));
        let std = std::array::from_fn(|channel| {
            instruments.measures(channel).then(|| libm::sqrt(covariance[(channel, channel)]))
        });
        let weight = Cholesky::new(covariance)?.inverse();
        Some(LinearRow { by_soil: Slopes::from_columns(&columns), by_slip, by_load, weight, std })
    }
}

fn stepped(soil: &Soil<f64>, axis: usize, step: f64) -> Soil<f64> {
    let mut soil = *soil;
    match axis {
        0 => soil.cohesion_pa *= libm::exp(step),
        1 => soil.friction_angle_rad += step,
        2 => soil.shear_modulus_m *= libm::exp(step),
        3 => soil.sinkage_exponent += step,
        4 => soil.frictional_modulus *= libm::exp(step),
        5 => soil.peak_stress_c1 += step,
        _ => soil.peak_stress_c2 += step,
    }
    soil
}
