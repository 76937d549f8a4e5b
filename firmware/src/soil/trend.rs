//! How resistance, sinkage and torque go with slip and load over the wheels of an instant.
//!
//! Cohesion differs from friction in how little of the shear strength goes with the load, and K shows in how the torque
//! goes with slip, the more the heavier the wheel. These are differences among wheels, small beside what the wheels have
//! in common, and a network learns them slowly from the wheels one by one. A regression over the wheels says them
//! outright: the means of the coefficients given the wheels and what is known of soils beforehand ([`super::trend_prior`]),
//! each wheel counted by how well its slip, load, forces and sinkage are known.
//!
//! The three channels hang together, by the soil and by common noise. Resistance comes first, then sinkage given the
//! resistance, then torque given both: what the channels before leave open of a coefficient narrows what is expected of it,
//! and the share of the torque's noise that has shown in the resistance is taken off. That the coefficients before are means
//! themselves, with errors, is left out: it would take one regression of all three channels, of 16 unknowns. Where the
//! sinkage is not seen the torque comes second, given the resistance alone, and the sinkage is what both let expect.

use heapless::Vec;

use crate::math;
use crate::network::TREND_FEATURES;
use crate::wheel_state::WHEELS;

use super::WheelFeatures;
use super::solve::solve;
use super::trend_prior::{RESISTANCE, SINKAGE, SINKAGE_EXPECTED, TORQUE, TORQUE_ALONE};

/// Regressors of resistance and torque: 1, v, v² and v³, v being a logarithmic measure of slip that is longer for heavier
/// wheels; a measure of load; and the product of both; see [`Bend`].
pub const TERMS: usize = 6;
/// Regressors of the sinkage: 1, u, u², q, where u is the measure of slip and q ten times the deviation of ln W from its mean.
pub const SINKAGE_TERMS: usize = 4;

/// How the regressors of a force are bent by the load, so that they follow loads that differ by half.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Change of v with q: v = u + `slip` q. A heavier wheel sinks in deeper, and shears more soil at the same slip.
    pub slip: f32,
    /// The measure of load is q + `load` q².
    pub load: f32,
    /// The measure of load is multiplied by u + `both` q.
    pub both: f32,
}

/// Bends of (T/r − DP)/W and of T/(rW): those that leave the least variance over soils under loads that differ by ±50 %, a
/// fortieth and a third of what is left without.
pub const BENDS: [Bend; 2] =
    [Bend { slip: 0.031, load: 0.019, both: 0.031 }, Bend { slip: 0.055, load: 0.0, both: -0.015 }];

/// What the regressors of resistance and torque are made of: v, the measure of load, and the product of both.
struct Terms {
    slip: f32,
    load: f32,
    both: f32,
}

/// What the regressors leave of (T/r − DP)/W, T/(rW) and ln(z/r) without any noise: variances, of the first two under equal
/// loads and means over soils whose wheels have slips spread as most training scenes have them.
pub const MISFIT: [f32; 3] = [9e-9, 1.2e-8, 8.4e-6];
/// What they leave more of the first two under loads that differ, over the mean of q².
pub const BENT_BY_LOAD: [f32; 2] = [5e-9, 5.3e-8];
/// Variance of (T/r − DP)/W and of T/(rW) by noise of the load, which is common to both: that of W/W̄ times the mean square
/// of how they change with ln W over the prior.
const BY_LOAD: f32 = 0.18;
/// The same of ln(z/r).
const SINKAGE_BY_LOAD: f32 = 0.4;
/// Variance of T/(rW) by noise of the slip: that of the slip times the square of the mean slope against
/// ln(slip + [`OFFSET`]), 0.12, over the square of that sum.
const BY_SLIP: f32 = 0.0144;
/// The least level of (T/r − DP)/W and of T/(rW) whose logarithm is taken; the mean over the prior is 0.3.
const LEAST_LEVEL: f32 = 0.02;
/// Added to slip where its logarithm is taken: of the values tried, 0.08 leaves the least misfit.
pub const OFFSET: f32 = 0.08;

/// One standard deviation of what the wheels show, as the features have it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrendNoise {
    /// Of DP/W̄.
    pub pull: f32,
    /// Of W/W̄.
    pub load: f32,
    /// Of T/(rW̄).
    pub torque: f32,
    /// Of the slip.
    pub slip: f32,
    /// Of z/r; none where the sinkage is not known.
    pub sinkage: Option<f32>,
}

/// Sums over the wheels of the last of their features, ln(W/(rb) / 10 kPa), and of its square.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LoadSums {
    sum: f32,
    squares: f32,
}

impl LoadSums {
    /// Counts a wheel in: where its features are made anyway, for less than in a pass over the wheels.
    #[inline(always)]
    pub fn add(&mut self, [.., ln_load]: &WheelFeatures) {
        self.sum += ln_load;
        self.squares += ln_load * ln_load;
    }
}

/// How the wheels' states go with slip and load: six coefficients of (T/r − DP)/W, the same six of T/(rW), four of ln(z/r), and
/// three numbers about the loads.
///
/// The six are those of Legendre's polynomials of degree 3, 0, 1 and 2 in v, of the load, and of the product, the four those
/// of degree 0, 1 and 2 in u and of q; where the sinkage is not known they are what the forces let expect. Of the six the one
/// of degree 0, the level, stands as its logarithm, and the torque's others are over its level: K shows in the shape of the
/// torque against slip, whatever the strength, and a network learns a product more slowly than a sum. The three are the
/// logarithms of the standard deviations of the torque's coefficients of the load, if that of the product were known, and of
/// the product; and the mean of ln W.
pub type Trend = [f32; TREND_FEATURES];

/// A wheel's place on the regressors, and what it shows.
struct Row {
    u: f32,
    q: f32,
    /// Slip + [`OFFSET`].
    shifted: f32,
    /// Of the channel that is being fitted.
    value: f32,
    /// One over the variance of that.
    information: f32,
}

/// Fits the trend over wheels.
// One caller: without a call nothing is copied.
#[inline(always)]
pub fn trend(wheels: &[WheelFeatures], loads: LoadSums, noise: TrendNoise) -> Trend {
    let share = 1.0 / wheels.len() as f32;
    let mean_ln_load = share * loads.sum;
    // The mean of q².
    let spread = 100.0 * (share * loads.squares - mean_ln_load * mean_ln_load);
    let [of_resistance, of_torque, of_sinkage] = MISFIT;
    let [resistance_bent, torque_bent] = BENT_BY_LOAD;
    let [resistance_bend, torque_bend] = BENDS;
    // Variance that the torque has in common with the resistance, and what the resistance has besides.
    let common = at_most_huge(noise.torque * noise.torque + BY_LOAD * noise.load * noise.load);
    let besides = at_most_huge(noise.pull * noise.pull + of_resistance + resistance_bent * spread);
    let information = 1.0 / (common + besides);
    let mut rows = Vec::<Row, WHEELS>::new();
    for wheel in wheels.iter().take(WHEELS) {
        // Not `collect`: heapless panics where it overflows.
        let _ = rows.push(Row::new(wheel, mean_ln_load, information));
    }
    let mut resistance = RESISTANCE.shift;
    fit_forces(&RESISTANCE.precision, &mut resistance, &rows, resistance_bend);

    let mut sinkage = SINKAGE.shift;
    let (known, mut torque) = if let Some(std) = noise.sinkage {
        add_product(&mut sinkage, &SINKAGE.by_resistance, &resistance);
        let level = SINKAGE_BY_LOAD * noise.load * noise.load + of_sinkage;
        let variance = std * std;
        let seen = rows.iter().zip(wheels).map(|(row, [_, _, _, sinkage, _])| {
            let sinkage = at_least(*sinkage, 0.005);
            let square = sinkage * sinkage;
            (row, math::ln(sinkage), square / (variance + level * square))
        });
        fit_sinkage(&SINKAGE.precision, &mut sinkage, seen);
        let mut torque = TORQUE.shift;
        add_product(&mut torque, &TORQUE.by_resistance, &resistance);
        add_product(&mut torque, &TORQUE.by_sinkage, &sinkage);
        (&TORQUE.precision, torque)
    } else {
        let mut torque = TORQUE_ALONE.shift;
        add_product(&mut torque, &TORQUE_ALONE.by_resistance, &resistance);
        (&TORQUE_ALONE.precision, torque)
    };
    // The share of what is left of the resistance that belongs to the torque, too.
    let shared = common * information;
    let level = shared * besides + of_torque + torque_bent * spread;
    let [constant, first, second, third, load, both] = resistance;
    let by_slip = BY_SLIP * noise.slip * noise.slip;
    for (row, [_, torque, ..]) in rows.iter_mut().zip(wheels) {
        let Terms { slip, load: by_load, both: by_both } = row.terms(resistance_bend);
        let fitted = constant + slip * (first + slip * (second + slip * third)) + by_load * load + by_both * both;
        let square = row.shifted * row.shifted;
        row.value = torque - shared * (row.value - fitted);
        row.information = square / (level * square + by_slip);
    }
    let precisions = fit_forces(known, &mut torque, &rows, torque_bend);
    if noise.sinkage.is_none() {
        // What the forces let expect: a network can go on from there as from what was seen.
        sinkage = SINKAGE_EXPECTED.shift;
        add_product(&mut sinkage, &SINKAGE_EXPECTED.by_resistance, &resistance);
        add_product(&mut sinkage, &SINKAGE_EXPECTED.by_torque, &torque);
    }
    normalised(resistance, torque, sinkage, precisions, mean_ln_load)
}

/// The trend of the coefficients that were fitted.
#[inline(always)] // as above
fn normalised(
    resistance: [f32; 6],
    torque: [f32; 6],
    sinkage: [f32; 4],
    precisions: [f32; 2],
    mean_ln_load: f32,
) -> Trend {
    let [load, both] = precisions.map(|precision| -0.5 * math::ln(precision));
    let [r0, resistance_level, r2, r3, r4, r5] = by_legendre(resistance);
    let [t0, torque_level, t2, t3, t4, t5] = by_legendre(torque);
    let levels @ [_, torque_level] = [resistance_level, torque_level].map(|level| at_least(level, LEAST_LEVEL));
    let [r1, t1] = levels.map(math::ln);
    let per_level = 1.0 / torque_level;
    let [t0, t2, t3, t4, t5] = [t0, t2, t3, t4, t5].map(|coefficient| per_level * coefficient);
    let [s0, s1, s2, s4] = sinkage;
    let [s0, s2] = [s0 + THIRD * s2, 2.0 * THIRD * s2];
    [r0, r1, r2, r3, r4, r5, t0, t1, t2, t3, t4, t5, s0, s1, s2, s4, load, both, mean_ln_load]
}

impl Row {
    fn new(wheel: &WheelFeatures, mean_ln_load: f32, information: f32) -> Self {
        let [pull, torque, slip, _, ln_load] = *wheel;
        // Torque rises steeply at small slip and levels off: nearly even in the logarithm. Slips of 0.02 … 0.7 become −1 … 1.
        let shifted = at_least(slip, 0.01) + OFFSET;
        let u = (math::ln(shifted) + 1.275_523) * 0.973_651;
        Self { u, q: 10.0 * (ln_load - mean_ln_load), shifted, value: torque - pull, information }
    }

    #[inline(always)]
    fn terms(&self, bend: Bend) -> Terms {
        let load = self.q + bend.load * self.q * self.q;
        Terms { slip: self.u + bend.slip * self.q, load, both: load * (self.u + bend.both * self.q) }
    }
}

/// The greater of two numbers; `least` for one that is none.
fn at_least(number: f32, least: f32) -> f32 {
    if number > least { number } else { least }
}

/// A variance; 10¹² in place of a greater one, whose products might be infinite.
fn at_most_huge(variance: f32) -> f32 {
    const HUGE: f32 = 1e12;
    if variance < HUGE { variance } else { HUGE }
}

/// Adds the coefficients times the rows of a matrix.
fn add_product<const N: usize, const M: usize>(sums: &mut [f32; N], rows: &[[f32; N]; M], coefficients: &[f32; M]) {
    for (coefficient, row) in coefficients.iter().zip(rows) {
        sums.iter_mut().zip(row).for_each(|(sum, change)| *sum += coefficient * change);
    }
}

/// One third.
const THIRD: f32 = 1.0 / 3.0;

/// Coefficients of powers of u turned into those of Legendre's polynomials, which stand apart better: a network learns more
/// from them.
fn by_legendre([constant, first, second, third, load, both]: [f32; TERMS]) -> [f32; TERMS] {
    [0.4 * third, constant + THIRD * second, first + 0.6 * third, 2.0 * THIRD * second, load, both]
}

/// Mean of the coefficients of resistance or torque given what is known of them and the wheels, in place of `right`, the
/// product of what is known with the mean. Returns the precisions of the last two, those behind them known.
// One copy in the image for both channels.
#[inline(never)]
fn fit_forces(known: &[[f32; TERMS]; TERMS], right: &mut [f32; TERMS], rows: &[Row], bend: Bend) -> [f32; 2] {
    // Sums of vᵏ, of vᵏ times the load and of vᵏ times the product, and of squares and products of these two.
    let ([mut s0, mut s1, mut s2, mut s3, mut s4, mut s5, mut s6], [mut m0, mut m1, mut m2, mut m3]) =
        ([0.0; 7], [0.0; 4]);
    let ([mut n0, mut n1, mut n2, mut n3], [mut l0, mut l1, mut l2]) = ([0.0; 4], [0.0; 3]);
    let [mut r0, mut r1, mut r2, mut r3, mut r4, mut r5] = *right;
    for row in rows {
        let Terms { slip, load, both } = row.terms(bend);
        let (w0, value) = (row.information, row.value);
        let w1 = w0 * slip;
        let w2 = w1 * slip;
        let w3 = w2 * slip;
        let w4 = w3 * slip;
        let w5 = w4 * slip;
        let (of_load, of_both) = (w0 * load, w0 * both);
        (s0, s1, s2, s3) = (s0 + w0, s1 + w1, s2 + w2, s3 + w3);
        (s4, s5, s6) = (s4 + w4, s5 + w5, s6 + w5 * slip);
        (m0, m1, m2, m3) = (m0 + of_load, m1 + w1 * load, m2 + w2 * load, m3 + w3 * load);
        (n0, n1, n2, n3) = (n0 + of_both, n1 + w1 * both, n2 + w2 * both, n3 + w3 * both);
        (l0, l1, l2) = (l0 + of_load * load, l1 + of_load * both, l2 + of_both * both);
        (r0, r1, r2, r3) = (r0 + w0 * value, r1 + w1 * value, r2 + w2 * value, r3 + w3 * value);
        (r4, r5) = (r4 + of_load * value, r5 + of_both * value);
    }
    *right = [r0, r1, r2, r3, r4, r5];
    // Symmetric: below the diagonal nobody looks.
    let mut left = [
        [s0, s1, s2, s3, m0, n0],
        [0.0, s2, s3, s4, m1, n1],
        [0.0, 0.0, s4, s5, m2, n2],
        [0.0, 0.0, 0.0, s6, m3, n3],
        [0.0, 0.0, 0.0, 0.0, l0, l1],
        [0.0, 0.0, 0.0, 0.0, 0.0, l2],
    ];
    solve(&mut left, known, right);
    let [.., [_, _, _, _, load, _], [.., both]] = left;
    [load, both]
}

/// The same for the sinkage: of each row, the value and one over the variance of that.
fn fit_sinkage<'a>(
    known: &[[f32; SINKAGE_TERMS]; SINKAGE_TERMS],
    right: &mut [f32; SINKAGE_TERMS],
    seen: impl Iterator<Item = (&'a Row, f32, f32)>,
) {
    let ([mut s0, mut s1, mut s2, mut s3, mut s4], [mut m0, mut m1, mut m2], mut l0) = ([0.0; 5], [0.0; 3], 0.0);
    let [mut r0, mut r1, mut r2, mut r3] = *right;
    for (Row { u, q, .. }, value, w0) in seen {
        let (w1, v0) = (w0 * u, w0 * q);
        let w2 = w1 * u;
        let w3 = w2 * u;
        (s0, s1, s2, s3, s4) = (s0 + w0, s1 + w1, s2 + w2, s3 + w3, s4 + w3 * u);
        (m0, m1, m2, l0) = (m0 + v0, m1 + w1 * q, m2 + w2 * q, l0 + v0 * q);
        (r0, r1, r2, r3) = (r0 + w0 * value, r1 + w1 * value, r2 + w2 * value, r3 + v0 * value);
    }
    *right = [r0, r1, r2, r3];
    let mut left = [[s0, s1, s2, m0], [0.0, s2, s3, m1], [0.0, 0.0, s4, m2], [0.0, 0.0, 0.0, l0]];
    solve(&mut left, known, right);
}

#[cfg(test)]
mod tests;
