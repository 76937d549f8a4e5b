//! The chance of a gain in likelihood where nothing is missing.
//!
//! Twice the gain in ln likelihood follows χ² where noise is known (Wilks 1938, Ann. Math. Statist. 9:60). Where it is estimated beside the
//! effect, of few readings, chance alone gains far more: that of a channel is then N/2 ln(SS₀ / SS₁), and what has a known law is Fisher's
//! ratio, ν (SS₀ / SS₁ − 1) over the parameters, with the ν degrees of freedom that are left to tell the noise. Several channels, whose
//! ratios add up, tell their weights from the same few readings, as Hotelling's T² does (1931, Ann. Math. Statist. 2:360): each channel
//! beside the first takes one degree of freedom.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::chance::{beside_noise, over_all, squares_gained};
use super::fit::{Fit, Reading};
use super::trial::Trial;

/// Degrees of freedom from which a noise is as good as known.
const KNOWN: f64 = 1e5;
/// Those that are left to tell a noise of which readings tell nothing.
const LEAST_FREEDOM: f64 = 0.1;

/// What a model gains by having something more.
#[derive(Debug, Clone, Copy)]
pub struct Gain<'a> {
    /// The model without.
    pub before: &'a Fit,
    /// The model with it.
    pub after: &'a Fit,
    /// Gain in ln likelihood and priors.
    pub ln_posterior: f64,
    /// The dispersion that it is measured in, 1 or more.
    pub dispersion: f64,
    /// Rows that tell as much as an independent one, 1 or more.
    pub rows_per_reading: f64,
}

impl<'a> Gain<'a> {
    /// Of a model with something more over that without, rows taken for independent.
    pub fn over(before: &'a Trial<'_>, after: &'a Trial<'_>, dispersion: f64) -> Self {
        let ln_posterior = after.log_posterior() - before.log_posterior();
        Self { before: &before.fit, after: &after.fit, ln_posterior, dispersion, rows_per_reading: 1.0 }
    }

    /// The gain in units of the dispersion.
    pub fn in_dispersions(&self) -> f64 {
        self.ln_posterior / self.dispersion
    }

    /// The chance that the best of `tried` candidates of so many parameters that change nothing gains as much.
    pub fn chance(&self, parameters: usize, tried: usize) -> f64 {
        let parameters = parameters.max(1) as f64;
        let Ratio { squares, freedom } = self.ratio();
        let per = self.dispersion * self.rows_per_reading;
        let (squares, freedom) = (squares.max(0.0) / per, freedom / self.rows_per_reading);
        let alone = if freedom < KNOWN {
            beside_noise(squares, parameters, freedom)
        } else {
            ChiSquared::new(parameters).map_or(1.0, |law| law.sf(squares))
        };
        over_all(alone, tried)
    }

    fn ratio(&self) -> Ratio {
        let mut of_known = 2.0 * self.ln_posterior;
        let mut of_unknown = Vec::new();
        for channel in Reading::JUDGED.into_iter().filter(|channel| self.before.estimates_noise(*channel)) {
            let pair = [self.before, self.after].map(|fit| fit.channel_squares(channel));
            let [Some(before), Some(after)] = pair else { continue };
            let ln_noise = 2.0 * (before.ln_noise - after.ln_noise);
            of_known -= ln_noise + before.squares - after.squares;
            let ln_ratio = ln_noise / before.count + (before.squares / after.squares).ln();
            let freedom = after.freedom.max(LEAST_FREEDOM);
            of_unknown.push(Ratio { squares: squares_gained(ln_ratio, freedom), freedom });
        }
        let total = of_unknown.iter().map(|part| part.squares).sum::<f64>();
        let gains: Vec<&Ratio> = of_unknown.iter().filter(|part| part.squares > 0.0).collect();
        let gained: f64 = gains.iter().map(|part| part.squares).sum();
        if gained <= 0.0 {
            return Ratio { squares: of_known + total, freedom: f64::INFINITY };
        }
        let channels = 1.0 / gains.iter().map(|part| (part.squares / gained).powi(2)).sum::<f64>();
        let least = gains.iter().map(|part| part.freedom).fold(f64::INFINITY, f64::min);
        let freedom = (least - (channels - 1.0)).max(LEAST_FREEDOM);
        let share = gained / (gained + of_known.max(0.0));
        Ratio { squares: of_known + total * freedom / least, freedom: freedom / (share * share) }
    }
}

/// By how much squares are less, over the variance of the noise, and the degrees of freedom that this is known with; ∞ where it is known.
#[derive(Debug, Clone, Copy)]
struct Ratio {
    squares: f64,
    freedom: f64,
}
