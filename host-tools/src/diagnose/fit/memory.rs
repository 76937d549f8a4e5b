//! Whether the noise of a row remembers that of the row before.

use super::observation::CHANNELS;
use super::outcome::Fit;

/// Standardised residual beyond which one counts as so large: an outlier is no memory.
const OUTLIER: f64 = 3.0;
/// Standard errors by which neighbours must go together, in whichever channel does most: of white noise fits come to as much once
/// in a hundred times.
const BEYOND_CHANCE: f64 = 3.0;

impl Fit {
    /// Whether what the fit leaves of a channel goes together in neighbouring rows of a run, more than independent noise does by
    /// chance. The fit takes noise for independent from row to row but for an offset of the run; where a sensor drifts, or the
    /// ground is not the same from place to place, rows say less than they seem to.
    pub fn remembers(&self) -> bool {
        (0..CHANNELS).any(|channel| self.memory(channel) > BEYOND_CHANCE)
    }

    /// Sum of the products of neighbouring residuals, in standard errors of independent ones.
    fn memory(&self, channel: usize) -> f64 {
        let residual = |row: usize| Some(self.standardised[row][channel]?.clamp(-OUTLIER, OUTLIER));
        let neighbours = (1..self.rows.len()).filter(|row| self.rows[*row].run == self.rows[row - 1].run);
        let products = neighbours.filter_map(|row| Some(residual(row - 1)? * residual(row)?));
        let (sum, squares) =
            products.fold((0.0, 0.0), |(sum, squares), product| (sum + product, squares + product * product));
        sum / squares.max(f64::MIN_POSITIVE).sqrt()
    }
}
