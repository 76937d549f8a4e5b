//! One quantity of the six wheels over time: six plots side by side on one scale.

use maud::{Markup, html};

use super::samples::{Sample, Samples};
use super::time_axis::{self, LEFT, RIGHT, Spread, WIDTH, runs, spreads};
use crate::report::draw::{Anchor, Scale, bottom_axis, left_axis, page_chart, path, text};
use crate::report::sentence::capitalised;
use crate::statistics::sorted;
use crate::wheel_quantity::WheelQuantity;

/// Height of a row of plots.
pub const HEIGHT: f64 = 176.0;
const TOP: f64 = 42.0;
const BOTTOM: f64 = HEIGHT - 32.0;
const GAP: f64 = 26.0;
/// The wheels in words, in the order of the files.
const WHEELS: [&str; 6] = ["front left", "middle left", "rear left", "front right", "middle right", "rear right"];

/// The chart of a quantity of all wheels.
pub struct WheelChart(pub WheelQuantity);

impl WheelChart {
    fn title(&self) -> String {
        capitalised(self.0.name())
    }

    /// The six plots, at the origin.
    pub fn draw(&self, samples: &Samples) -> Markup {
        let scale = self.scale(samples);
        let unit = if self.0.unit().is_empty() { String::new() } else { format!(", {}", self.0.unit()) };
        html! {
            (text("title", (LEFT, 14.0), Anchor::Start, &format!("{}{unit}", self.title())))
            (left_axis(&scale, (LEFT, WIDTH - RIGHT)))
            @for (place, wheel) in WHEELS.iter().enumerate() { (self.plot(samples, &scale, place, wheel)) }
            (time_axis::name(WIDTH - RIGHT, BOTTOM))
        }
    }

    /// The six plots in an SVG element of their own.
    pub fn svg(&self, samples: &Samples) -> Markup {
        let words = format!("{} of the six wheels over time, with one and two standard deviations", self.title());
        page_chart((WIDTH, HEIGHT), &words, &self.draw(samples))
    }

    fn plot(&self, samples: &Samples, scale: &Scale, place: usize, wheel: &str) -> Markup {
        let width = (WIDTH - LEFT - RIGHT + GAP) / WHEELS.len() as f64;
        let left = LEFT + width * place as f64;
        let time = time_axis::scale(samples.span_s(), (left, left + width - GAP)).sparse();
        let estimated = samples.series(|sample| self.spread(sample, place));
        let truth = samples.series(|sample| {
            let value = self.true_value(sample, place)?;
            Some((time.at(sample.time_s()), scale.at(value)))
        });
        html! {
            (text("label", (left, TOP - 8.0), Anchor::Start, wheel))
            (bottom_axis(&time, (TOP, BOTTOM)))
            @for run in runs(estimated, |_, _| true) { (spreads("told", &time, scale, &run)) }
            @for run in runs(truth, |_, _| true) { (path("truth", &run)) }
        }
    }

    fn spread(&self, sample: &Sample, place: usize) -> Option<Spread> {
        let wheel = sample.estimate.wheels.iter_wheels().nth(place)?;
        let estimate = self.0.estimate(wheel)?;
        let [value, std] = [estimate.value, estimate.std].map(|number| self.0.shown(number.into()));
        let [inner, outer] = [1.0, 2.0].map(|stds| [value - stds * std, value + stds * std]);
        Some(Spread { time_s: sample.time_s(), value, inner, outer })
    }

    fn true_value(&self, sample: &Sample, place: usize) -> Option<f64> {
        let wheel = sample.truth.as_ref()?.wheels.iter_wheels().nth(place)?;
        self.0.truth(wheel).map(|value| self.0.shown(value)).filter(|value| value.is_finite())
    }

    /// A scale that holds nearly all values with their standard deviations: the first moments, when nothing is known, and
    /// single spikes may run off it.
    fn scale(&self, samples: &Samples) -> Scale {
        const LEFT_OUT: f64 = 0.01;
        let places = || samples.kept().iter().flat_map(|sample| (0..WHEELS.len()).map(move |place| (sample, place)));
        let estimated =
            places().filter_map(|(sample, place)| self.spread(sample, place)).flat_map(|spread| spread.inner);
        let truth = places().filter_map(|(sample, place)| self.true_value(sample, place));
        let values = sorted(estimated.chain(truth).filter(|value| value.is_finite()));
        let cut = (LEFT_OUT * values.len() as f64) as usize;
        let kept = values.get(cut..values.len().saturating_sub(cut)).unwrap_or(&[]);
        Scale::around(kept.iter().copied(), (BOTTOM, TOP))
    }
}
