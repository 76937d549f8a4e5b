//! What the rover network's inputs take for known of the trend over the wheels, against soils drawn and fitted anew.

use std::ops::Range;
use std::sync::LazyLock;

use kapvik_firmware::soil::trend::{BENDS, BENT_BY_LOAD, Bend, MISFIT, OFFSET, SINKAGE_TERMS, TERMS};
use kapvik_firmware::soil::trend_prior::{Known, RESISTANCE, SINKAGE, SINKAGE_EXPECTED, TORQUE, TORQUE_ALONE};
use kapvik_firmware::wheel_state::WheelState;
use kapvik_host::prior;
use kapvik_host::train::dataset::stream;
use nalgebra::{DMatrix, DVector};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Soils that are drawn.
const SOILS: usize = 3000;
/// Wheels on each.
const WHEELS: usize = 40;
/// Where the coefficients of (T/r − DP)/W, of ln(z/r) and of T/(rW) stand in one list, and the end of the list.
const PLACES: [usize; 4] = [0, TERMS, TERMS + SINKAGE_TERMS, 2 * TERMS + SINKAGE_TERMS];

/// Powers of the slip's measure, that of the load and the product, of which the sinkage has fewer, as combinations of Legendre's
/// polynomials: a column a power.
fn powers_by_legendre(terms: usize) -> DMatrix<f64> {
    let mut all = DMatrix::identity(TERMS, TERMS);
    (all[(0, 2)], all[(2, 2)], all[(1, 3)], all[(3, 3)]) = (1.0 / 3.0, 2.0 / 3.0, 0.6, 0.4);
    if terms == TERMS { all } else { all.remove_column(5).remove_row(5).remove_column(3).remove_row(3) }
}

/// Wheels on one soil: of (T/r − DP)/W, ln(z/r) and T/(rW) the regressors, with Legendre's polynomials, and the values; mean
/// of q².
struct Drawn {
    channels: [(DMatrix<f64>, DVector<f64>); 3],
    mean_square_q: f64,
}

/// The regressors of a force at a slip and a load.
fn terms(Bend { slip, load, both }: Bend, u: f64, q: f64) -> [f64; TERMS] {
    let (v, load) = (u + f64::from(slip) * q, q + f64::from(load) * q * q);
    [1.0, v, (3.0 * v * v - 1.0) / 2.0, (5.0 * v * v * v - 3.0 * v) / 2.0, load, load * (u + f64::from(both) * q)]
}

/// Draws a soil and wheels at slips between two; none where it does not carry them all.
fn drawn(random: &mut ChaCha8Rng, [low, high]: [f64; 2]) -> Option<Drawn> {
    let mut share = || random.random::<f64>();
    let soil = prior::any_soil(&mut share);
    let wheel = prior::KAPVIK_WHEEL;
    let (mean_n, spread) = (prior::KAPVIK_LOADS_N.at(share()), prior::LOAD_SPREAD.at(share()));
    let offset = f64::from(OFFSET);
    let (least, most) = (libm::log(0.02 + offset), libm::log(0.70 + offset));
    let (mut places, mut seen) = (Vec::new(), Vec::new());
    for _ in 0..WHEELS {
        let slip = low + (high - low) * share();
        let load_n = mean_n * (1.0 + spread * (2.0 * share() - 1.0));
        let state = WheelState::under_load(&wheel, &soil, slip, load_n).ok()?;
        let sinkage_m = state.sinkage_m?;
        if sinkage_m > prior::DEEPEST * wheel.radius_m {
            return None;
        }
        let u = (2.0 * libm::log(slip + offset) - least - most) / (most - least);
        places.push((u, 10.0 * libm::log(load_n / mean_n)));
        let torque = state.torque_nm / (wheel.radius_m * load_n);
        seen.push([torque - state.drawbar_pull_n / load_n, libm::log(sinkage_m / wheel.radius_m), torque]);
    }
    let values = |channel: usize| DVector::from_iterator(WHEELS, seen.iter().map(|values| values[channel]));
    let regressors = |bend: Bend| {
        let terms = places.iter().flat_map(|&(u, q)| terms(bend, u, q));
        DMatrix::from_row_iterator(WHEELS, TERMS, terms)
    };
    let of_sinkage = regressors(Bend { slip: 0.0, load: 0.0, both: 0.0 }).remove_column(5).remove_column(3);
    let [of_resistance, of_torque] = BENDS.map(regressors);
    let mean_square_q = places.iter().map(|(_, q)| q * q).sum::<f64>() / WHEELS as f64;
    let channels = [(of_resistance, values(0)), (of_sinkage, values(1)), (of_torque, values(2))];
    Some(Drawn { channels, mean_square_q })
}

/// Coefficients of all three channels on one soil, of Legendre's polynomials; none where it does not carry all wheels.
fn coefficients(index: usize) -> Option<DVector<f64>> {
    let Drawn { channels, .. } = drawn(&mut stream(7, index), [0.02, 0.70])?;
    let mut all = Vec::new();
    for (regressors, values) in channels {
        all.extend(regressors.svd(true, true).solve(&values, 1e-12).ok()?.iter());
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

/// The drawn coefficients at some places given those at others: change of the mean with those, mean where those are zero,
/// covariance; and the covariance of the others by themselves.
struct Given {
    gain: DMatrix<f64>,
    mean: DVector<f64>,
    covariance: DMatrix<f64>,
    before: DMatrix<f64>,
}

fn given(own: Range<usize>, others: &[usize]) -> Given {
    let (mean, covariance, _) = &*DISTRIBUTION;
    let own: Vec<usize> = own.collect();
    let part = |rows: &[usize], columns: &[usize]| covariance.select_rows(rows).select_columns(columns);
    let (before, across) = (part(others, others), part(&own, others));
    let gain = &across * before.clone().try_inverse().expect("positive definite");
    let covariance = part(&own, &own) - &gain * across.transpose();
    Given { mean: mean.select_rows(&own) - &gain * mean.select_rows(others), gain, covariance, before }
}

/// On coordinates in which the drawn coefficients are standard normal precisions are unit matrices, and means zero, but for
/// the sampling errors of two sets of soils: at most √(2/N) each if they are near to normal. Six of both.
fn bound() -> f64 {
    6.0 * libm::sqrt(4.0 / DISTRIBUTION.2)
}

/// Holds a gain and a mean, both as [`Given`] has them, against the drawn ones.
fn check_means(drawn: &Given, gain: &DMatrix<f64>, mean: &DVector<f64>, others: &[usize], name: &str) {
    let whitened = drawn.covariance.clone().cholesky().expect("positive definite").l();
    let whitened = whitened.try_inverse().expect("positive definite");
    // The mean where all before it is at its own.
    let before = DISTRIBUTION.0.select_rows(others);
    let missed = &whitened * (mean + gain * &before - &drawn.mean - &drawn.gain * &before);
    assert!(missed.amax() < bound(), "{name}: mean off by {missed}");
    if !others.is_empty() {
        let root_before = drawn.before.clone().cholesky().expect("positive definite").l();
        let missed = whitened * (gain - &drawn.gain) * root_before;
        assert!(missed.amax() < bound(), "{name}: dependence off by {missed}");
    }
}

/// Holds what is known of the coefficients at places `own`, given all those of the channels that it knows of, against the
/// drawn distribution.
fn check<const N: usize, const R: usize, const S: usize>(known: &Known<N, R, S>, name: &str, own: Range<usize>) {
    let others: Vec<usize> = (0..R + S).collect();
    let drawn = given(own, &others);
    let precision = columns(&known.precision);
    let root = drawn.covariance.clone().cholesky().expect("positive definite").l();
    let difference = root.transpose() * &precision * &root - DMatrix::identity(N, N);
    assert!(difference.amax() < bound(), "{name}: precision off by {difference}");
    let (by_resistance, by_sinkage) = (columns(&known.by_resistance), columns(&known.by_sinkage));
    let moved = DMatrix::from_fn(N, R + S, |row, column| {
        if column < R { by_resistance[(row, column)] } else { by_sinkage[(row, column - R)] }
    });
    let shift = DVector::from_iterator(N, known.shift.iter().map(|&value| f64::from(value)));
    let covariance = precision.try_inverse().expect("positive definite");
    check_means(&drawn, &(&covariance * moved), &(covariance * shift), &others, name);
}

#[test]
fn what_is_known_of_the_resistance_is_that_of_the_soils() {
    check(&RESISTANCE, "resistance", PLACES[0]..PLACES[1]);
}

#[test]
fn what_is_known_of_the_sinkage_is_that_of_the_soils() {
    check(&SINKAGE, "sinkage", PLACES[1]..PLACES[2]);
}

#[test]
fn what_is_known_of_the_torque_is_that_of_the_soils() {
    check(&TORQUE, "torque", PLACES[2]..PLACES[3]);
}

#[test]
fn what_is_known_of_the_torque_without_sinkage_is_that_of_the_soils() {
    check(&TORQUE_ALONE, "torque alone", PLACES[2]..PLACES[3]);
}

#[test]
fn the_sinkage_that_is_expected_is_that_of_the_soils() {
    let others: Vec<usize> = (PLACES[0]..PLACES[1]).chain(PLACES[2]..PLACES[3]).collect();
    let (by_resistance, by_torque) = (columns(&SINKAGE_EXPECTED.by_resistance), columns(&SINKAGE_EXPECTED.by_torque));
    let gain = DMatrix::from_fn(SINKAGE_TERMS, 2 * TERMS, |row, column| {
        if column < TERMS { by_resistance[(row, column)] } else { by_torque[(row, column - TERMS)] }
    });
    let mean = DVector::from_iterator(SINKAGE_TERMS, SINKAGE_EXPECTED.shift.iter().map(|&value| f64::from(value)));
    check_means(&given(PLACES[1]..PLACES[2], &others), &gain, &mean, &others, "sinkage expected");
}

/// What SINKAGE and TORQUE say together of the torque given the resistance alone, and of the sinkage given both: matrices
/// with a column for each row of the tables, in the order of the tables.
fn from_all_channels() -> [DMatrix<f64>; 6] {
    let column = |shift: &[f32]| DMatrix::from_iterator(shift.len(), 1, shift.iter().map(|&value| f64::from(value)));
    let (sinkage, torque) = (columns(&SINKAGE.precision), columns(&TORQUE.precision));
    let by_sinkage = columns(&TORQUE.by_sinkage);
    let inverse = |matrix: &DMatrix<f64>| matrix.clone().try_inverse().expect("positive definite");
    // Torque: the sinkage integrated out. Its covariance is that given both, and what the sinkage adds.
    let of_sinkage = &by_sinkage * inverse(&sinkage);
    let shift = column(&TORQUE.shift) + &of_sinkage * column(&SINKAGE.shift);
    let by_resistance = columns(&TORQUE.by_resistance) + &of_sinkage * columns(&SINKAGE.by_resistance);
    let gain = &torque * inverse(&(&torque + &of_sinkage * by_sinkage.transpose()));
    let precision = &gain * &torque;
    let precision = 0.5 * (&precision + precision.transpose());
    // Sinkage: Bayes' rule on both, the torque being given.
    let of_torque = by_sinkage.transpose() * inverse(&torque);
    let covariance = inverse(&(&sinkage + &of_torque * &by_sinkage));
    let expected = &covariance * (column(&SINKAGE.shift) - &of_torque * column(&TORQUE.shift));
    let moved = &covariance * (columns(&SINKAGE.by_resistance) - &of_torque * columns(&TORQUE.by_resistance));
    [precision, &gain * shift, gain * by_resistance, expected, moved, covariance * by_sinkage.transpose()]
}

#[test]
fn what_is_known_where_the_sinkage_is_not_seen_is_what_all_channels_say_together() {
    let expected = from_all_channels();
    let carried = [
        columns(&TORQUE_ALONE.precision),
        columns(&[TORQUE_ALONE.shift]),
        columns(&TORQUE_ALONE.by_resistance),
        columns(&[SINKAGE_EXPECTED.shift]),
        columns(&SINKAGE_EXPECTED.by_resistance),
        columns(&SINKAGE_EXPECTED.by_torque),
    ];
    for (carried, expected) in carried.iter().zip(&expected) {
        let near = carried.zip_map(expected, |carried, expected| (carried - expected).abs() <= 1e-4 * expected.abs());
        assert!(near.iter().all(|&near| near), "column by column: {:.6e}", expected);
    }
}

/// Mean of q² of the loads, and mean squares of what the regressors leave of (T/r − DP)/W and T/(rW) without noise, on a
/// soil under wheels as most training scenes have them; none where it does not carry them all.
fn left_over(index: usize) -> Option<[f64; 3]> {
    let mut random = stream(8, index);
    let slips = [prior::SPREAD_SLIP_LOW, prior::SPREAD_SLIP_HIGH].map(|range| range.at(random.random()));
    let Drawn { channels: [resistance, _, torque], mean_square_q } = drawn(&mut random, slips)?;
    let rest = |(regressors, values): (DMatrix<f64>, DVector<f64>)| {
        let fit = regressors.clone().svd(true, true).solve(&values, 1e-12).ok()?;
        Some((values - regressors * fit).norm_squared() / (WHEELS - TERMS) as f64)
    };
    Some([mean_square_q, rest(resistance)?, rest(torque)?])
}

#[test]
fn misfit_is_what_the_regressors_leave() {
    let mut soils: Vec<[f64; 3]> = (0..SOILS).filter_map(left_over).collect();
    soils.sort_by(|a, b| a[0].total_cmp(&b[0]));
    for soils in soils.chunks(soils.len() / 6 + 1) {
        let mean = |pick: usize| soils.iter().map(|soil| soil[pick]).sum::<f64>() / soils.len() as f64;
        for channel in 0..2 {
            let said = f64::from(MISFIT[channel]) + f64::from(BENT_BY_LOAD[channel]) * mean(0);
            let ratio = mean(1 + channel) / said;
            // Two numbers stand for all soils, slips and loads; some soils leave ten times as much as others.
            assert!((0.5..2.0).contains(&ratio), "channel {channel}, mean q² {:.2}: {ratio} of {said:e}", mean(0));
        }
    }
}
