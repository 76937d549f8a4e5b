//! From numbers to pixels.

/// Where a scale begins and ends on the picture.
pub type Pixels = (f64, f64);

/// A linear or logarithmic scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
    pixels: Pixels,
    logarithmic: bool,
    /// Ticks are at least so many, on a linear scale.
    least_ticks: f64,
}

/// Ticks of a scale that nobody asked for fewer.
const LEAST_TICKS: f64 = 3.2;

impl Scale {
    /// A linear scale; `low` below `high`.
    pub fn linear(low: f64, high: f64, pixels: Pixels) -> Self {
        Self { low, high, pixels, logarithmic: false, least_ticks: LEAST_TICKS }
    }

    /// A logarithmic scale; both above zero.
    pub fn logarithmic(low: f64, high: f64, pixels: Pixels) -> Self {
        Self { low, high, pixels, logarithmic: true, least_ticks: LEAST_TICKS }
    }

    /// A linear scale that holds all `values` and zero, with some room.
    pub fn around(values: impl Iterator<Item = f64>, pixels: Pixels) -> Self {
        let (low, high) = values
            .filter(|value| value.is_finite())
            .fold((0.0, 0.0), |(low, high): (f64, f64), value| (low.min(value), high.max(value)));
        let span = if high > low { high - low } else { 1.0 };
        let room = 0.06 * span;
        Self::linear(if low < 0.0 { low - room } else { 0.0 }, high + room, pixels)
    }

    /// With fewer ticks, for a short axis: from two to four.
    pub fn sparse(self) -> Self {
        Self { least_ticks: 1.6, ..self }
    }

    /// The place of a number; beyond the scale it is at its end.
    pub fn at(&self, value: f64) -> f64 {
        let (start, end) = self.pixels;
        let value = value.clamp(self.low, self.high);
        let share = if self.logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        start + share * (end - start)
    }

    /// Where it begins and ends on the picture.
    pub fn pixels(&self) -> Pixels {
        self.pixels
    }

    /// Round numbers along the scale.
    pub fn ticks(&self) -> Vec<f64> {
        if self.logarithmic { self.logarithmic_ticks() } else { self.linear_ticks() }
    }

    fn linear_ticks(&self) -> Vec<f64> {
        let most = (self.high - self.low) / self.least_ticks;
        let decade = 10_f64.powf(most.log10().floor());
        let step = decade * [5.0, 2.0, 1.0].into_iter().find(|step| step * decade <= most).unwrap_or(1.0);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last).map(|count| count as f64 * step).collect()
    }

    fn logarithmic_ticks(&self) -> Vec<f64> {
        let decades = self.low.log10().floor() as i32..=self.high.log10().ceil() as i32;
        let steps: &[f64] = if (self.high / self.low).log10() > 1.4 { &[1.0, 3.0] } else { &[1.0, 2.0, 5.0] };
        let all = decades.flat_map(|decade| steps.iter().map(move |step| step * 10_f64.powi(decade)));
        all.filter(|tick| (self.low..=self.high).contains(tick)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middles_are_where_they_belong() {
        let linear = Scale::linear(20.0, 40.0, (100.0, 200.0));
        assert_eq!([20.0, 30.0, 40.0, 50.0].map(|value| linear.at(value)), [100.0, 150.0, 200.0, 200.0]);
        let logarithmic = Scale::logarithmic(10.0, 1000.0, (0.0, 100.0));
        assert!((logarithmic.at(100.0) - 50.0).abs() < 1e-9);
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(Scale::linear(21.0, 43.0, (0.0, 1.0)).ticks(), [25.0, 30.0, 35.0, 40.0]);
        assert_eq!(Scale::linear(-7.0, 16.0, (0.0, 1.0)).ticks(), [-5.0, 0.0, 5.0, 10.0, 15.0]);
        assert_eq!(Scale::logarithmic(50.0, 3000.0, (0.0, 1.0)).ticks(), [100.0, 300.0, 1000.0, 3000.0]);
        assert_eq!(Scale::logarithmic(5.0, 35.0, (0.0, 1.0)).ticks(), [5.0, 10.0, 20.0]);
    }
}
