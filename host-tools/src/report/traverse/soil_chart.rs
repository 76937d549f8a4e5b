//! One parameter of the soil under the rover over time.

use kapvik_firmware::soil::SoilEstimate;
use maud::{Markup, html};

use super::findings::TraverseFindings;
use super::samples::Sample;
use super::time_axis::{self, LEFT, RIGHT, Spread, WIDTH, runs, spreads};
use crate::data::truth_file::TrueSoil;
use crate::parameter::Parameter;
use crate::report::draw::{Anchor, Scale, bottom_axis, left_axis, line, page_chart, path, px, text};

/// Height of a chart.
pub const HEIGHT: f64 = 190.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = HEIGHT - 32.0;

/// The chart of a parameter.
pub struct SoilChart<'a> {
    /// The parameter.
    pub parameter: Parameter,
    /// What is drawn.
    pub findings: &'a TraverseFindings,
}

impl SoilChart<'_> {
    /// The chart, at the origin.
    pub fn draw(&self) -> Markup {
        let parameter = self.parameter;
        let scale = parameter.scale((BOTTOM, TOP));
        let samples = &self.findings.samples;
        let time = time_axis::scale(samples.span_s(), (LEFT, WIDTH - RIGHT));
        let estimated = samples.series(|sample| self.spread(sample));
        let truth = samples.series(|sample| {
            let value = parameter.true_value(sample)?;
            Some((time.at(sample.time_s()), scale.at(parameter.shown(value))))
        });
        html! {
            text class="title" x=(px(LEFT)) y="14" {
                (parameter.name()) " " tspan class="symbol" { (parameter.symbol()) } ", " (parameter.unit())
            }
            (bottom_axis(&time, (TOP, BOTTOM)))
            (left_axis(&scale, (LEFT, WIDTH - RIGHT)))
            @for run in runs(estimated, |(one, _), (two, _)| one == two) { (self.run(&time, &scale, &run)) }
            @for run in runs(truth, |_, _| true) { (path("truth", &run)) }
            (self.changes(&time))
            (time_axis::name(WIDTH - RIGHT, BOTTOM))
        }
    }

    /// The chart in an SVG element of its own.
    pub fn svg(&self) -> Markup {
        let words = format!("{} under the rover over time, with 68 % and 95 % intervals", self.parameter.name());
        page_chart((WIDTH, HEIGHT), &words, &self.draw())
    }

    fn run(&self, time: &Scale, scale: &Scale, run: &[(bool, Spread)]) -> Markup {
        let told = run.first().is_some_and(|(told, _)| *told);
        let run: Vec<Spread> = run.iter().map(|(_, spread)| *spread).collect();
        spreads(if told { "told" } else { "untold" }, time, scale, &run)
    }

    /// Where another soil was noticed.
    fn changes(&self, time: &Scale) -> Markup {
        html! {
            @for change in &self.findings.outcome.soil_changes_us {
                @let place = time.at(1e-6 * *change as f64);
                (line("change", (place, TOP), (place, BOTTOM)))
                @if self.parameter == Parameter::Cohesion {
                    (text("change-label", (place, TOP - 5.0), Anchor::Middle, "another soil"))
                }
            }
        }
    }

    fn spread(&self, sample: &Sample) -> Option<(bool, Spread)> {
        let soil: &SoilEstimate = &sample.estimate.soil.as_ref().ok()?.estimate;
        let estimate = self.parameter.of(soil);
        let shown = |value: f32| self.parameter.shown(value.into());
        let spread = Spread {
            time_s: sample.time_s(),
            value: shown(estimate.value),
            inner: estimate.interval_68.map(shown),
            outer: estimate.interval_95.map(shown),
        };
        Some((estimate.identifiable, spread))
    }
}

impl Parameter {
    /// The truth of it at a sample, in SI units, where it is known.
    pub fn true_value(self, sample: &Sample) -> Option<f64> {
        let TrueSoil { cohesion_pa, friction_angle_rad, shear_modulus_m, .. } = sample.truth.as_ref()?.soil;
        let value = match self {
            Self::Cohesion => cohesion_pa,
            Self::FrictionAngle => friction_angle_rad,
            Self::ShearModulus => shear_modulus_m,
        };
        value.is_finite().then_some(value)
    }
}
