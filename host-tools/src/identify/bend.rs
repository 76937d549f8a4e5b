//! Means over different slips and loads, brought onto the curve.
//!
//! Forces bend with slip and load, so that their mean over rows is not what the wheel does at the mean slip under the mean
//! load: of 45, 65 and 90 N by up to a per cent, which no number of rows averages away and the networks, who take a state for
//! one of a wheel, know nothing of. By how much, what all the states show together tells: soils are drawn from the prior, the
//! run is rehearsed on each, and what the bends are there is regressed on what the sensors show there (the best linear
//! predictor, from means and covariances over the soils). No bend is taken for greater than on any of these soils.

use kapvik_firmware::wheel_state::WheelState;
use nalgebra::{DMatrix, DVector};
use rand::RngExt;

use crate::prior;

use super::combine::MeanState;
use super::layout::{Forces, Layout, Rehearsed};

/// Soils that are drawn: ten and more for each of the 18 numbers that six states show.
const SOILS: u64 = 256;
/// Share of the variances that is added to them, which keeps a covariance sound whatever the sensors' noise.
const RIDGE: f64 = 1e-9;

/// By how much means lie beside the curve, for what the sensors show.
#[derive(Debug, Clone)]
pub struct Bends {
    mean_shown: DVector<f64>,
    mean_bend: DVector<f64>,
    /// Bends in the columns' order of [`numbers`] by what is shown.
    slope: DMatrix<f64>,
    low: DVector<f64>,
    high: DVector<f64>,
}

impl Bends {
    /// Of a layout; none where there is nothing to bring onto a curve, or too few soils carry the wheels to say it.
    pub fn of(layout: &Layout) -> Option<Self> {
        if !layout.is_mixed() {
            return None;
        }
        let runs = layout.rehearse(0..SOILS, |random| prior::any_soil(|| random.random()));
        let runs: Vec<Rehearsed> = runs.into_iter().map(|(_, run)| run).collect();
        let shown = columns(runs.iter().map(|run| numbers(&run.states)))?;
        let bend = columns(runs.iter().map(|run| run.bends.as_flattened().to_vec()))?;
        let (mean_shown, mean_bend) = (shown.column_mean(), bend.column_mean());
        let about = |matrix: &DMatrix<f64>, mean: &DVector<f64>| {
            let mut matrix = matrix.clone();
            matrix.column_iter_mut().for_each(|mut column| column -= mean);
            matrix
        };
        let (about_shown, about_bend) = (about(&shown, &mean_shown), about(&bend, &mean_bend));
        // Of unit variance, so that newtons and metres count alike.
        let scale =
            DVector::from_iterator(shown.nrows(), about_shown.row_iter().map(|row| row.norm().max(f64::MIN_POSITIVE)));
        let unit =
            DMatrix::from_fn(shown.nrows(), shown.ncols(), |row, column| about_shown[(row, column)] / scale[row]);
        let covariance = &unit * unit.transpose() + DMatrix::identity(shown.nrows(), shown.nrows()) * RIDGE;
        let solved = covariance.cholesky()?.solve(&(&unit * about_bend.transpose()));
        let slope = DMatrix::from_fn(bend.nrows(), shown.nrows(), |row, column| solved[(column, row)] / scale[column]);
        let end = |pick: fn(f64, f64) -> f64| {
            DVector::from_iterator(bend.nrows(), bend.row_iter().map(|row| row.iter().copied().fold(row[0], pick)))
        };
        Some(Self { mean_shown, mean_bend, slope, low: end(f64::min), high: end(f64::max) })
    }

    /// The states brought onto the curve.
    pub fn straightened(&self, states: &[WheelState<f64>]) -> Vec<WheelState<f64>> {
        let shown = DVector::from_vec(numbers(states));
        let bend = &self.mean_bend + &self.slope * (shown - &self.mean_shown);
        let bend: Vec<f64> = bend
            .iter()
            .zip(self.low.iter().zip(&self.high))
            .map(|(bend, (low, high))| bend.clamp(*low, *high))
            .collect();
        let (bends, _) = bend.as_chunks::<3>();
        states.iter().zip(bends).map(|(state, bend)| moved(state, *bend)).collect()
    }

    /// The same of means of rows.
    pub fn of_means(&self, states: &[MeanState]) -> Vec<MeanState> {
        let shown: Vec<_> = states.iter().map(|state| state.mean.wheel_state()).collect();
        let straight = self.straightened(&shown);
        let mut states = states.to_vec();
        for (state, straight) in states.iter_mut().zip(straight) {
            state.mean.drawbar_pull_n = Some(straight.drawbar_pull_n);
            state.mean.torque_nm = Some(straight.torque_nm);
            state.mean.sinkage_m = straight.sinkage_m;
        }
        states
    }
}

/// A state, its forces and sinkage moved.
pub fn moved(state: &WheelState<f64>, [drawbar_pull_n, torque_nm, sinkage_m]: Forces) -> WheelState<f64> {
    WheelState {
        drawbar_pull_n: state.drawbar_pull_n + drawbar_pull_n,
        torque_nm: state.torque_nm + torque_nm,
        sinkage_m: state.sinkage_m.map(|sinkage| sinkage + sinkage_m),
        ..*state
    }
}

/// What is seen of forces, state by state; nothing where there is no sinkage.
fn numbers(states: &[WheelState<f64>]) -> Vec<f64> {
    states.iter().flat_map(|state| [state.drawbar_pull_n, state.torque_nm, state.sinkage_m.unwrap_or(0.0)]).collect()
}

/// A matrix of these columns; none of fewer than two for each of its rows.
fn columns(columns: impl Iterator<Item = Vec<f64>>) -> Option<DMatrix<f64>> {
    let columns: Vec<DVector<f64>> = columns.map(DVector::from_vec).collect();
    let rows = columns.first()?.len();
    (columns.len() >= 2 * rows).then(|| DMatrix::from_columns(&columns))
}
