//! Statistics of samples, and how series hang together.

pub mod autocorrelation;
pub mod running;

/// A number and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// One standard error.
    pub standard_error: f64,
}

/// The values in rising order.
pub fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The lowest and the highest of some values; none of none.
pub fn ends(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let wider =
        |(low, high): (f64, f64), (other_low, other_high): (f64, f64)| (low.min(other_low), high.max(other_high));
    values.into_iter().map(|value| (value, value)).reduce(wider)
}

/// The value below which a share 0 … 1 of sorted values lies, between neighbours in proportion; not a number of none.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * sorted.len().saturating_sub(1) as f64;
    let at = |place: f64| sorted.get(place as usize).copied().unwrap_or(f64::NAN);
    let (low, high) = (at(place.floor()), at(place.ceil()));
    low + (high - low) * place.fract()
}

/// The middle one of some values, or the mean of the two middle ones; not a number of none.
pub fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    quantile(&sorted(values), 0.5)
}

/// The root of the mean square; not a number of none.
pub fn root_mean_square(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values.into_iter().fold((0.0, 0.0), |(sum, count), value| (sum + value * value, count + 1.0));
    f64::sqrt(sum / count)
}

/// A standard deviation over the median of absolute values, of a normal distribution.
pub const PER_MEDIAN: f64 = 1.482_6;

/// The standard deviation of errors about zero, from the median of their sizes: a few gross ones do not move it; not a number of none.
pub fn robust_std(errors: impl IntoIterator<Item = f64>) -> f64 {
    PER_MEDIAN * median(errors.into_iter().map(f64::abs))
}

/// Values less their mean.
pub fn centred(values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|value| value - mean).collect()
}

/// Correlation of two columns whose means are zero; 0 where one of them is zero throughout.
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let squares = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
    product / (squares(a) * squares(b)).sqrt().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::{ends, median, quantile, root_mean_square, sorted};

    #[test]
    fn quantiles_lie_between_neighbours() {
        let values = sorted([3.0, 1.0, 2.0, 5.0]);
        assert_eq!(values, [1.0, 2.0, 3.0, 5.0]);
        assert_eq!([0.0, 0.5, 0.75, 1.0].map(|share| quantile(&values, share)), [1.0, 2.5, 3.5, 5.0]);
        assert_eq!(median([4.0, 1.0, 9.0]), 4.0);
        assert!(median([]).is_nan());
        assert_eq!(root_mean_square([3.0, -4.0, 0.0, 0.0]), 2.5);
        assert!(root_mean_square([]).is_nan());
        assert_eq!(ends([3.0, 1.0, 2.0]), Some((1.0, 3.0)));
        assert_eq!(ends([]), None);
    }
}
