//! What the rover network's inputs take for known of the trend over the wheels, against soils drawn and fitted anew.

use std::sync::LazyLock;

use kapvik_firmware::soil::trend::{OFFSET, SINKAGE_TERMS, TERMS};
use kapvik_firmware::soil::trend_prior::{Known, RESISTANCE, SINKAGE, TORQUE, TORQUE_ALONE};
use kapvik_firmware::wheel_state::WheelState;
use kapvik_host::train::dataset::stream;
use kapvik_host::train::prior;
use nalgebra::{DMatrix, DVector};
use rand::RngExt;

/// Soils that are drawn.
const SOILS: usize = 3000;
/// Wheels on each.
const WHEELS: usize = 40;
/// Where the coefficients of (T/r − DP)/W, of ln(z/r) and of T/(rW) stand in one list, and the end of the list.
const PLACES: [usize; 4] = [0, TERMS, TERMS + SINKAGE_TERMS, 2 * TERMS + SINKAGE_TERMS];

/// Powers of u, q and u q, of which the sinkage has fewer, as combinations of Legendre's polynomials: a column a power.
fn powers_by_legendre(terms: usize) -> DMatrix<f64> {
    let mut all = DMatrix::identity(TERMS, TERMS);
    (all[(0, 2)], all[(2, 2)], all[(1, 3)], all[(3, 3)]) = (1.0 / 3.0, 2.0 / 3.0, 0.6, 0.4);
    if terms == TERMS { all } else { all.remove_column(5).remove_row(5).remove_column(3).remove_row(3) }
}

/// Coefficients of all three channels on one soil, of Legendre's polynomials; none where it does not carry all wheels.
fn coefficients(index: usize) -> Option<DVector<f64>> {
    let mut random = stream(7, index);
    let mut share = || random.random::<f64>();
    let soil = prior::soil(prior::SOIL_RANGES.map(|range| range.at(share())));
    let wheel = prior::KAPVIK_WHEEL;
    let (mean_n, spread) = (prior::KAPVIK_LOADS_N.at(share()), prior::LOAD_SPREAD.at(share()));
    let offset = f64::from(OFFSET);
    let (least, most) = (libm::log(0.02 + offset), libm::log(0.70 + offset));
    let mut regressors = DMatrix::zeros(WHEELS, TERMS);
    let mut values = [(); 3].map(|()| DVector::zeros(WHEELS));
    for place in 0..WHEELS {
        let slip = 0.02 + 0.68 * share();
        let load_n = mean_n * (1.0 + spread * (2.0 * share() - 1.0));
        let state = WheelState::under_load(&wheel, &soil, slip, load_n).ok()?;
        let sinkage_m = state.sinkage_m?;
        if sinkage_m > prior::DEEPEST * wheel.radius_m {
            return None;
        }
        let u = (2.0 * libm::log(slip + offset) - least - most) / (most - least);
        let q = 10.0 * libm::log(load_n / mean_n);
        let terms = [1.0, u, (3.0 * u * u - 1.0) / 2.0, (5.0 * u * u * u - 3.0 * u) / 2.0, q, u * q];
        terms.into_iter().enumerate().for_each(|(term, value)| regressors[(place, term)] = value);
        let torque = state.torque_nm / (wheel.radius_m * load_n);
        values[0][place] = torque - state.drawbar_pull_n / load_n;
        values[1][place] = libm::log(sinkage_m / wheel.radius_m);
        values[2][place] = torque;
    }
    let fewer = regressors.clone().remove_column(5).remove_column(3);
    let mut all = Vec::new();
    for (values, regressors) in values.iter().zip([&regressors, &fewer, &regressors]) {
        all.extend(regressors.clone().svd(true, true).solve(values, 1e-12).ok()?.iter());
    }
    Some(DVector::from_vec(all))
}

/// What the drawn soils say, for all tests.
static DISTRIBUTION: LazyLock<(DVector<f64>, DMatrix<f64>, f64)> = LazyLock::new(distribution);

/// Mean and covariance of the drawn coefficients, of powers of u; each variance 0.3 % larger; and how many soils were drawn.
fn distribution() -> (DVector<f64>, DMatrix<f64>, f64) {
    let fits: Vec<DVector<f64>> = (0..SOILS).filter_map(coefficients).collect();
    let count = fits.len() as f64;
    assert!(count > 0.8 * SOILS as f64, "{count} soils carry all wheels");
    let size = PLACES[3];
    let mean = fits.iter().fold(DVector::zeros(size), |sum, fit| sum + fit) / count;
    let mut covariance = DMatrix::zeros(size, size);
    for fit in &fits {
        let deviation = fit - &mean;
        covariance += &deviation * deviation.transpose() / count;
    }
    for term in 0..size {
        covariance[(term, term)] *= 1.003;
    }
    let mut turn = DMatrix::zeros(size, size);
    for channel in 0..3 {
        let (from, terms) = (PLACES[channel], PLACES[channel + 1] - PLACES[channel]);
        let inverse = powers_by_legendre(terms).try_inverse().expect("triangular");
        turn.view_mut((from, from), (terms, terms)).copy_from(&inverse);
    }
    (&turn * mean, &turn * covariance * turn.transpose(), count)
}

/// A list of rows as a matrix with a column for each row.
fn columns<const N: usize, const M: usize>(rows: &[[f32; N]; M]) -> DMatrix<f64> {
    DMatrix::from_fn(N, M, |row, column| f64::from(rows[column][row]))
}

/// Holds what is known of the channel behind `given` coefficients against the drawn distribution.
fn check<const N: usize, const R: usize, const S: usize>(known: &Known<N, R, S>, name: &str, given: usize) {
    let (mean, covariance, count) = &*DISTRIBUTION;
    // On coordinates in which the drawn coefficients are standard normal precisions are unit matrices, and means zero, but
    // for the sampling errors of two sets of soils: at most √(2/N) each if they are near to normal. Six of both.
    let bound = 6.0 * libm::sqrt(4.0 / count);
    let before = covariance.view((0, 0), (given, given)).into_owned();
    let across = covariance.view((given, 0), (N, given)).into_owned();
    let own = covariance.view((given, given), (N, N)).into_owned();
    let gain = &across * before.clone().try_inverse().expect("positive definite");
    let left_open = own - &gain * across.transpose();
    let root = left_open.cholesky().expect("positive definite").l();
    let precision = columns(&known.precision);
    let difference = root.transpose() * &precision * &root - DMatrix::identity(N, N);
    assert!(difference.amax() < bound, "{name}: precision off by {difference}, bound {bound}");
    // What moves the mean, and the mean where all before it is at its own.
    let (by_resistance, by_sinkage) = (columns(&known.by_resistance), columns(&known.by_sinkage));
    let moved = DMatrix::from_fn(N, given, |row, column| {
        if column < R { by_resistance[(row, column)] } else { by_sinkage[(row, column - R)] }
    });
    let shift = DVector::from_iterator(N, known.shift.iter().map(|&value| f64::from(value)));
    let (mean_before, mean_own) = (mean.rows(0, given).into_owned(), mean.rows(given, N).into_owned());
    let missed = root.transpose() * (shift + &moved * mean_before - &precision * mean_own);
    assert!(missed.amax() < bound, "{name}: mean off by {missed}, bound {bound}");
    if given > 0 {
        let root_before = before.cholesky().expect("positive definite").l();
        let missed = root.transpose() * (moved - &precision * gain) * root_before;
        assert!(missed.amax() < bound, "{name}: dependence off by {missed}, bound {bound}");
    }
}

#[test]
fn what_is_known_of_the_resistance_is_that_of_the_soils() {
    check(&RESISTANCE, "resistance", PLACES[0]);
}

#[test]
fn what_is_known_of_the_sinkage_is_that_of_the_soils() {
    check(&SINKAGE, "sinkage", PLACES[1]);
}

#[test]
fn what_is_known_of_the_torque_is_that_of_the_soils() {
    check(&TORQUE, "torque", PLACES[2]);
}

/// What is known of the torque given the resistance alone: the sinkage's coefficients integrated out of what is known of
/// both. Precision, shift, and what the resistance changes of that, a column a coefficient.
fn torque_alone() -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>) {
    let column = |shift: &[f32]| DMatrix::from_iterator(shift.len(), 1, shift.iter().map(|&value| f64::from(value)));
    let (sinkage, torque) = (columns(&SINKAGE.precision), columns(&TORQUE.precision));
    let by_sinkage = columns(&TORQUE.by_sinkage);
    let of_sinkage = &by_sinkage * sinkage.try_inverse().expect("positive definite");
    // Of the product of precision and mean; its covariance is that of the torque given both, and what the sinkage adds.
    let shift = column(&TORQUE.shift) + &of_sinkage * column(&SINKAGE.shift);
    let by_resistance = columns(&TORQUE.by_resistance) + &of_sinkage * columns(&SINKAGE.by_resistance);
    let covariance = &torque + &of_sinkage * by_sinkage.transpose();
    let gain = &torque * covariance.try_inverse().expect("positive definite");
    let precision = &gain * &torque;
    (0.5 * (&precision + precision.transpose()), &gain * shift, &gain * by_resistance)
}

#[test]
fn what_is_known_of_the_torque_without_sinkage_is_what_all_channels_say_together() {
    let (precision, shift, by_resistance) = torque_alone();
    let near = |found: f32, expected: f64, sizes: [f64; 2]| {
        (f64::from(found) - expected).abs() < 1e-4 * (sizes[0] * sizes[1]).sqrt()
    };
    let mut near_all = true;
    for row in 0..TERMS {
        near_all &= near(TORQUE_ALONE.shift[row], shift[row], [shift[row].abs().max(1.0); 2]);
        for column in 0..TERMS {
            let sizes = [precision[(row, row)], precision[(column, column)]];
            near_all &= near(TORQUE_ALONE.precision[row][column], precision[(row, column)], sizes);
            let moved = by_resistance[(column, row)];
            near_all &= near(TORQUE_ALONE.by_resistance[row][column], moved, [moved.abs().max(1.0); 2]);
        }
    }
    assert!(
        near_all,
        "precision, shift and by_resistance (row by row) are {precision:.8e}{shift:.8e}{}",
        by_resistance.transpose()
    );
}
