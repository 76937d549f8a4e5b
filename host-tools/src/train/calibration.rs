//! Interval factors, measured on cases that took no part in training.

use kapvik_firmware::network::{IntervalFactors, KNOTS, OUTPUTS, PosteriorScale, TARGETS};
use rayon::prelude::*;

use super::dataset::prior_scale;
use super::example::Example;
use super::score::truth;

/// What the outputs of a flown network mean, with interval factors from what it says on `set`: cases are sorted by how much the data
/// told of them, and in each of as many equal groups as there are knots the factor is the quantile of |error| over standard deviation.
pub fn calibrated<I: Sync>(set: &[Example<I>], flown: impl Fn(&I) -> [f32; OUTPUTS] + Sync) -> PosteriorScale {
    let mut scale = prior_scale();
    let posteriors: Vec<_> = set.par_iter().map(|example| scale.read(&flown(&example.input))).collect();
    let truths: Vec<_> = set.iter().map(|example| truth(example, &scale)).collect();
    for k in 0..TARGETS {
        let prior = scale.std[k];
        let mut cases: Vec<(f32, f32)> = posteriors
            .iter()
            .zip(&truths)
            .map(|(posterior, truth)| {
                let marginal = posterior[k];
                (marginal.std / prior, ((f64::from(marginal.mean) - truth[k]) / f64::from(marginal.std)).abs() as f32)
            })
            .collect();
        cases.sort_by(|left, right| left.0.total_cmp(&right.0));
        scale.intervals[k] = factors(&cases);
    }
    scale
}

/// Factors of cases (ratio, |error| in standard deviations) sorted by ratio.
fn factors(cases: &[(f32, f32)]) -> IntervalFactors {
    let mut factors = IntervalFactors::ZERO;
    let size = cases.len() / KNOTS;
    for (knot, group) in cases.chunks_exact(size.max(1)).take(KNOTS).enumerate() {
        let mut errors: Vec<f32> = group.iter().map(|case| case.1).collect();
        errors.sort_by(f32::total_cmp);
        let quantile = |share: f64| errors[((errors.len() - 1) as f64 * share).round() as usize];
        let middle = group[group.len() / 2].0;
        // Knots must increase; where nearly all cases are alike they would coincide.
        let least = if knot == 0 { 0.0 } else { factors.ratio[knot - 1] + 1e-4 };
        factors.ratio[knot] = middle.max(least);
        factors.factor_68[knot] = quantile(0.68);
        factors.factor_95[knot] = quantile(0.95);
    }
    factors
}
