//! What the rover network's inputs take for known of the trend over the wheels, against soils drawn and fitted anew.

use kapvik_firmware::soil::trend::{OFFSET, PRIOR, TERMS};
use kapvik_firmware::wheel_state::WheelState;
use kapvik_host::train::dataset::stream;
use kapvik_host::train::prior;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use rand::RngExt;

/// Soils that are drawn.
const SOILS: usize = 3000;
/// Wheels on each.
const WHEELS: usize = 40;

type Coefficients = SVector<f64, TERMS>;

/// Coefficients of (T/r − DP)/W and T/(rW) on one soil; none where it does not carry all wheels.
fn coefficients(index: usize) -> Option<[Coefficients; 2]> {
    let mut random = stream(7, index);
    let mut share = || random.random::<f64>();
    let soil = prior::soil(prior::SOIL_RANGES.map(|range| range.at(share())));
    let wheel = prior::KAPVIK_WHEEL;
    let (mean_n, spread) = (prior::KAPVIK_LOADS_N.at(share()), prior::LOAD_SPREAD.at(share()));
    let offset = f64::from(OFFSET);
    let (least, most) = (libm::log(0.02 + offset), libm::log(0.70 + offset));
    let mut regressors = DMatrix::zeros(WHEELS, TERMS);
    let mut values = [DVector::zeros(WHEELS), DVector::zeros(WHEELS)];
    for place in 0..WHEELS {
        let slip = 0.02 + 0.68 * share();
        let load_n = mean_n * (1.0 + spread * (2.0 * share() - 1.0));
        let state = WheelState::under_load(&wheel, &soil, slip, load_n).ok()?;
        if state.sinkage_m? > prior::DEEPEST * wheel.radius_m {
            return None;
        }
        let u = (2.0 * libm::log(slip + offset) - least - most) / (most - least);
        let q = 10.0 * libm::log(load_n / mean_n);
        let terms = [1.0, u, (3.0 * u * u - 1.0) / 2.0, (5.0 * u * u * u - 3.0 * u) / 2.0, q, u * q];
        terms.into_iter().enumerate().for_each(|(term, value)| regressors[(place, term)] = value);
        let torque = state.torque_nm / (wheel.radius_m * load_n);
        values[0][place] = torque - state.drawbar_pull_n / load_n;
        values[1][place] = torque;
    }
    let fit = regressors.svd(true, true);
    let solved = values.map(|values| fit.solve(&values, 1e-12).ok());
    let [resistance, torque] = solved;
    Some([resistance?, torque?].map(|solution| Coefficients::from_iterator(solution.iter().copied())))
}

#[test]
fn the_prior_of_the_trend_is_that_of_the_soils() {
    let fits: Vec<[Coefficients; 2]> = (0..SOILS).filter_map(coefficients).collect();
    let count = fits.len() as f64;
    assert!(count > 0.8 * SOILS as f64, "{count} soils carry all wheels");
    let mean = |channel: usize| fits.iter().map(|fit| fit[channel]).sum::<Coefficients>() / count;
    let mean_torque = mean(1);
    let mut covariance = SMatrix::<f64, TERMS, TERMS>::zeros();
    for fit in &fits {
        let deviation = fit[1] - mean_torque;
        covariance += deviation * deviation.transpose() / count;
    }
    for term in 0..TERMS {
        covariance[(term, term)] *= 1.01;
    }
    let root = covariance.cholesky().expect("positive definite").l();
    let precision = SMatrix::<f64, TERMS, TERMS>::from_fn(|row, column| f64::from(PRIOR[row][column]));
    // On coordinates in which the drawn coefficients are standard normal the precision is the unit matrix, but for the
    // sampling errors of two sets of as many soils: √(2/N) each on the diagonal if they are near to normal. Six of both.
    let bound = 6.0 * libm::sqrt(4.0 / count);
    let white = root.transpose() * precision * root;
    let difference = white - SMatrix::identity();
    assert!(difference.amax() < bound, "{difference} beyond {bound}");
    for (channel, mean) in [mean(0), mean_torque].into_iter().enumerate() {
        let held = Coefficients::from_fn(|row, _| f64::from(PRIOR[row][TERMS + channel]));
        let white = root.transpose() * (held - precision * mean);
        assert!(white.amax() < bound, "channel {channel}: {white} beyond {bound}");
    }
}
