//! How many neighbouring values of a series say as much as one by itself.
//!
//! The mean of n values that hang together is as good as one of n / τ independent ones, τ = 1 + 2 Σ ρₖ, with ρₖ the correlation of values
//! k apart. The sum ends where it would add noise alone: at the first two lags that together are not positive (initial positive
//! sequence; C. J. Geyer 1992, Statistical Science 7:473-483). Values scatter about the mean of their own series, which has taken a
//! part of all correlations away; that is put back.

/// Fewest values of a series that say how they hang together.
const FEWEST: usize = 8;
/// Standard errors by which neighbours must go together: independent ones come to as much once in 160 times.
const BEYOND_CHANCE: f64 = 2.5;
/// Lags that are summed at most: what is remembered for longer is hardly told from what is true.
const MOST_LAGS: usize = 2000;

/// Mean product of values so many places apart, and how many pairs there are.
fn covariance(series: &[Vec<f64>], lag: usize) -> (f64, f64) {
    let products = series.iter().flat_map(|series| series.iter().zip(series.iter().skip(lag)));
    let (sum, pairs) = products.fold((0.0, 0.0), |(sum, pairs), (one, other)| (sum + one * other, pairs + 1.0));
    (sum / f64::max(pairs, 1.0), pairs)
}

/// Correlation of neighbours in some series about their means, and how many pairs of them there are; none where nothing varies.
pub fn neighbours(series: &[Vec<f64>]) -> (f64, f64) {
    let ((variance, _), (first, pairs)) = (covariance(series, 0), covariance(series, 1));
    if variance > 0.0 { (first / variance, pairs) } else { (0.0, pairs) }
}

/// τ of some series about their means, of those that are long enough: 1 where neighbours do not go together beyond chance.
pub fn autocorrelation_time(mut series: Vec<Vec<f64>>) -> f64 {
    series.retain(|series| series.len() >= FEWEST);
    let Some(longest) = series.iter().map(Vec::len).max() else { return 1.0 };
    let (first, pairs) = neighbours(&series);
    if first * pairs.sqrt() <= BEYOND_CHANCE {
        return 1.0;
    }
    let (variance, values) = covariance(&series, 0);
    let (mut sum, mut lags) = (first, 1);
    while lags + 2 < MOST_LAGS.min(longest / 2) {
        let both = (covariance(&series, lags + 1).0 + covariance(&series, lags + 2).0) / variance;
        if both <= 0.0 {
            break;
        }
        sum += both;
        lags += 2;
    }
    unbiased(1.0 + 2.0 * sum, lags, values / series.len() as f64)
}

/// τ from 1 + 2 Σ ρₖ over some lags, the correlations being those about the mean of `length` rows. That mean's variance, τ over
/// the length times that of a row, is missing in every covariance; and where it is all that is left of one, the sum
/// has ended, and what fades from there on adds as much as it would by an exponential. Both together are a quadratic equation
/// for τ.
fn unbiased(seen: f64, lags: usize, length: f64) -> f64 {
    let kept = 1.0 + (seen - 1.0 - 2.0 * lags as f64) / length;
    let root = (kept * kept - 4.0 * seen / length).max(0.0).sqrt();
    (0.5 * length * (kept - root)).clamp(1.0, length)
}
