//! Whether chains have converged, and how many independent draws they are worth.
//!
//! Split-R̂ and the effective sample size over several chains as in A. Gelman et al., "Bayesian Data Analysis" (3rd ed., 2013),
//! section 11.4–11.5, with Geyer's initial monotone sequence (C. J. Geyer, Statistical Science 7 (1992) 473–483).

/// What is known of the mean of one quantity from several chains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Diagnosis {
    /// Mean over all draws.
    pub mean: f64,
    /// Posterior standard deviation.
    pub std: f64,
    /// Potential scale reduction over halves of chains; 1 at convergence.
    pub split_r_hat: f64,
    /// Independent draws that would tell the mean as well.
    pub effective_size: f64,
}

impl Diagnosis {
    /// Of chains of equal length, at least four draws each.
    pub fn of(chains: &[Vec<f64>]) -> Self {
        let halves: Vec<&[f64]> = chains.iter().flat_map(|chain| halves(chain)).collect();
        let length = halves.first().map_or(0, |half| half.len());
        let means: Vec<f64> = halves.iter().map(|half| mean(half)).collect();
        let centred: Vec<Vec<f64>> =
            halves.iter().zip(&means).map(|(half, mean)| half.iter().map(|x| x - mean).collect()).collect();
        let (count, draws) = (halves.len() as f64, length as f64);
        let within = centred.iter().map(|half| products(half, 0)).sum::<f64>() / (count * (draws - 1.0));
        let between = variance(&means);
        let pooled = within * (draws - 1.0) / draws + between;
        let correlation = |lag: usize| {
            let covariance = centred.iter().map(|half| products(half, lag)).sum::<f64>() / (count * (draws - 1.0));
            1.0 - (within - covariance) / pooled
        };
        Self {
            mean: mean(&means),
            std: libm::sqrt(pooled),
            split_r_hat: libm::sqrt(pooled / within),
            effective_size: count * draws / autocorrelation_time(length, correlation),
        }
    }

    /// Monte-Carlo standard error of the mean.
    pub fn standard_error(&self) -> f64 {
        self.std / libm::sqrt(self.effective_size)
    }
}

fn halves(chain: &[f64]) -> [&[f64]; 2] {
    let half = chain.len() / 2;
    [&chain[..half], &chain[chain.len() - half..]]
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn variance(values: &[f64]) -> f64 {
    let mean = mean(values);
    values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (values.len() as f64 - 1.0)
}

fn products(values: &[f64], lag: usize) -> f64 {
    values.iter().zip(values.iter().skip(lag)).map(|(a, b)| a * b).sum()
}

/// 1 + 2 Σ ρ, summed by pairs of lags for as long as the pairs are positive and made to fall.
fn autocorrelation_time(length: usize, correlation: impl Fn(usize) -> f64) -> f64 {
    let mut sum = -1.0;
    let mut least = f64::INFINITY;
    for lag in (0..length.saturating_sub(1)).step_by(2) {
        let pair = correlation(lag) + correlation(lag + 1);
        if pair <= 0.0 {
            break;
        }
        least = least.min(pair);
        sum += 2.0 * least;
    }
    // Chains that swing about the mean are not credited with more than three times their draws.
    sum.max(1.0 / 3.0)
}
