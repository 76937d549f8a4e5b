//! The chance of a gain in likelihood where nothing is missing.
//!
//! Twice the gain in ln likelihood follows χ² where noise is known (Wilks 1938, Ann. Math. Statist. 9:60). Where it is estimated beside the
//! effect, of few readings, chance alone gains far more: that of a channel is then N/2 ln(SS₀ / SS₁), and what has a known law is Fisher's
//! ratio, ν (SS₀ / SS₁ − 1) over the parameters, with the ν degrees of freedom that are left to tell the noise. Several channels, whose
//! ratios add up, tell their weights from the same few readings, as Hotelling's T² does (1931, Ann. Math. Statist. 2:360): each channel
//! beside the first takes one degree of freedom.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::chance::{beside_noise, over_all, squares_gained};
use super::fit::{ChannelSquares, Fit, Reading};
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

    /// The chance that the best of `tried` candidates of so many parameters that change nothing gains as much. Where noise goes together along
    /// runs that of the lesser of two chances: one as if all of the gain were within runs, one with what is gained between them by itself.
    pub fn chance(&self, parameters: usize, tried: usize) -> f64 {
        let parameters = parameters.max(1) as f64;
        let all = self.ratio();
        let within = all.over(self.dispersion).of_fewer(self.rows_per_reading);
        let between = (self.rows_per_reading > 1.0).then(|| self.by_parts(&all, parameters)).flatten();
        let views: Vec<f64> =
            [Some(within), between].into_iter().flatten().map(|ratio| ratio.chance(parameters)).collect();
        over_all(views.iter().copied().fold(1.0, f64::min), tried * views.len())
    }

    /// The gain within runs, in which a row tells less than an independent one, and that between them, in which it does not: each run has an
    /// offset already, whose spread the runs themselves tell. None of runs that are too few to tell it.
    fn by_parts(&self, all: &Ratio, parameters: f64) -> Option<Ratio> {
        let runs = Reading::JUDGED.map(|channel| told_runs(&self.before.series(channel.index())));
        let channels = runs.iter().filter(|runs| **runs > 0).count().max(1) as f64;
        let runs = *runs.iter().max()? as f64;
        // What the model without had from the runs, each of its channels tells a part of.
        let freedom = runs - self.before.parameters_told() / channels - parameters;
        let gain = 2.0 * self.ln_posterior;
        if freedom < 1.0 || gain <= 0.0 {
            return None;
        }
        let share = (self.squares_within_runs() / gain).clamp(0.0, 1.0);
        let within =
            Ratio { squares: share * all.squares, ..*all }.over(self.dispersion).of_fewer(self.rows_per_reading);
        let ln_ratio = (1.0 - share) * gain / self.dispersion / runs;
        Some(within.and(&Ratio { squares: squares_gained(ln_ratio, freedom), freedom }))
    }

    /// By how much squares within runs are less, over the variance of the noise; all of what a channel gains whose noise is estimated.
    fn squares_within_runs(&self) -> f64 {
        let of_channel = |channel: Reading| {
            if let Some(unknown) = self.of_unknown_noise(channel) {
                return unknown.gained();
            }
            let [before, after] = [self.before, self.after].map(|fit| squares(&fit.series(channel.index())));
            before - after
        };
        Reading::JUDGED.into_iter().map(of_channel).sum()
    }

    /// A channel whose noise is estimated, and of which something was read.
    fn of_unknown_noise(&self, channel: Reading) -> Option<UnknownNoise> {
        let squares = |fit: &Fit| fit.channel_squares(channel).filter(|_| self.before.estimates_noise(channel));
        Some(UnknownNoise { before: squares(self.before)?, after: squares(self.after)? })
    }

    fn ratio(&self) -> Ratio {
        let mut of_known = 2.0 * self.ln_posterior;
        let mut of_unknown = Vec::new();
        for unknown in Reading::JUDGED.into_iter().filter_map(|channel| self.of_unknown_noise(channel)) {
            of_known -= unknown.gained();
            let UnknownNoise { before, after } = &unknown;
            let ln_ratio = unknown.ln_noise() / before.count + (before.squares / after.squares).ln();
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

/// What is left of a channel without something more and with it, each in units of the noise that the fit has it with.
struct UnknownNoise {
    before: ChannelSquares,
    after: ChannelSquares,
}

impl UnknownNoise {
    /// Twice the sum of ln of by how much the noise of each reading is less.
    fn ln_noise(&self) -> f64 {
        2.0 * (self.before.ln_noise - self.after.ln_noise)
    }

    /// Twice the gain in ln likelihood.
    fn gained(&self) -> f64 {
        self.ln_noise() + self.before.squares - self.after.squares
    }
}

/// Runs of which a channel says something.
fn told_runs(series: &[Vec<f64>]) -> usize {
    series.iter().filter(|run| !run.is_empty()).count()
}

fn squares(series: &[Vec<f64>]) -> f64 {
    series.iter().flatten().map(|left| left * left).sum()
}

/// By how much squares are less, over the variance of the noise, and the degrees of freedom that this is known with; ∞ where it is known.
#[derive(Debug, Clone, Copy)]
struct Ratio {
    squares: f64,
    freedom: f64,
}

impl Ratio {
    /// In units of a dispersion; what is lost is nothing gained.
    fn over(self, dispersion: f64) -> Self {
        Self { squares: self.squares.max(0.0) / dispersion, ..self }
    }

    /// Where so many rows tell as much as an independent one.
    fn of_fewer(self, rows_per_reading: f64) -> Self {
        Self { squares: self.squares / rows_per_reading, freedom: self.freedom / rows_per_reading }
    }

    /// Both together, with the degrees of freedom of a sum (Satterthwaite 1946, Biometrics Bulletin 2:110).
    fn and(&self, other: &Self) -> Self {
        let squares = self.squares + other.squares;
        let doubt = self.squares.powi(2) / self.freedom + other.squares.powi(2) / other.freedom;
        Self { squares, freedom: if doubt > 0.0 { squares.powi(2) / doubt } else { f64::INFINITY } }
    }

    /// The chance that so many parameters that change nothing lessen squares by as much.
    fn chance(&self, parameters: f64) -> f64 {
        if self.freedom < KNOWN {
            return beside_noise(self.squares, parameters, self.freedom);
        }
        ChiSquared::new(parameters).map_or(1.0, |law| law.sf(self.squares))
    }
}
