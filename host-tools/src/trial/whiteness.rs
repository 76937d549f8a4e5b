//! Whether innovations are white: the test of Ljung and Box (1978, Biometrika 65:297–303).

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Lags that are looked at.
const LAGS: usize = 20;

/// The chance of as much autocorrelation in white noise; none of a series too short or without variance.
pub fn ljung_box(series: &[f64]) -> Option<f64> {
    let count = series.len() as f64;
    if series.len() < 4 * LAGS {
        return None;
    }
    let mean = series.iter().sum::<f64>() / count;
    let covariance = |lag: usize| -> f64 {
        series.iter().zip(series.iter().skip(lag)).map(|(now, later)| (now - mean) * (later - mean)).sum()
    };
    let variance = covariance(0);
    if variance <= 0.0 {
        return None;
    }
    let sum: f64 = (1..=LAGS).map(|lag| (covariance(lag) / variance).powi(2) / (count - lag as f64)).sum();
    let statistic = count * (count + 2.0) * sum;
    ChiSquared::new(LAGS as f64).ok().map(|chi_squared| chi_squared.sf(statistic))
}

#[cfg(test)]
mod tests {
    use super::ljung_box;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    #[test]
    fn white_noise_passes_and_a_moving_average_does_not() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let white: Vec<f64> = (0..2000).map(|_| StandardNormal.sample(&mut random)).collect();
        let coloured: Vec<f64> = white.windows(2).map(|pair| pair.iter().sum()).collect();
        assert!(ljung_box(&white).is_some_and(|p| p > 0.01));
        assert!(ljung_box(&coloured).is_some_and(|p| p < 1.0e-6));
    }
}
