//! The picture of the estimates: one panel for each parameter, one line for each estimate.

use kapvik_firmware::soil::SoilEstimate;
use maud::{Markup, html};

use crate::data::campaign::Ground;

use super::draw::{Anchor, Scale, bottom_axis, dot, line, px, ring, text, vertical_band};
use super::findings::{EstimateRow, RowKind};
use super::verdict::Verdict;
use crate::parameter::Parameter;

/// Height of a line of the panel.
const LINE: f64 = 24.0;
/// What stands above the lines: title, and where the direct tests lie.
const HEAD: f64 = 54.0;
/// What stands below: the axis.
const FOOT: f64 = 26.0;
/// Room for the labels of the lines.
const LABELS: f64 = 92.0;
/// Width of a panel without labels.
const PLOT: f64 = 250.0;
/// Room right of the plot, for half of the last tick's number.
const MARGIN: f64 = 14.0;

/// One panel.
pub struct Panel<'a> {
    /// What is estimated.
    pub parameter: Parameter,
    /// The lines, from above.
    pub rows: &'a [EstimateRow],
    /// What is known of the soil by other means.
    pub ground: &'a Ground,
    /// Whether the lines carry their labels.
    pub labelled: bool,
}

impl Panel<'_> {
    /// Width in pixels.
    pub fn width(&self) -> f64 {
        self.left() + PLOT + MARGIN
    }

    /// Height in pixels.
    pub fn height(&self) -> f64 {
        self.bottom() + FOOT
    }

    /// The panel's shapes, at the origin.
    pub fn draw(&self) -> Markup {
        let scale = self.parameter.scale((self.left(), self.left() + PLOT));
        html! {
            (self.title())
            (self.prior(&scale))
            (bottom_axis(&scale, (HEAD, self.bottom())))
            (self.direct(&scale))
            @for (place, row) in self.rows.iter().enumerate() {
                (self.row(&scale, row, HEAD + (place as f64 + 0.5) * LINE))
            }
        }
    }

    /// The panel in an SVG element of its own.
    pub fn svg(&self) -> Markup {
        let (width, height) = (px(self.width()), px(self.height()));
        html! {
            svg class="panel" viewBox={ "0 0 " (width) " " (height) } role="img" aria-label=(self.in_words()) {
                (self.draw())
            }
        }
    }

    fn left(&self) -> f64 {
        if self.labelled { LABELS } else { MARGIN }
    }

    fn bottom(&self) -> f64 {
        HEAD + self.rows.len() as f64 * LINE
    }

    fn title(&self) -> Markup {
        let parameter = self.parameter;
        html! {
            text class="title" x=(px(self.left())) y="16" {
                (parameter.name()) " " tspan class="symbol" { (parameter.symbol()) } ", " (parameter.unit())
            }
        }
    }

    /// What the networks take to be possible before any data.
    fn prior(&self, scale: &Scale) -> Markup {
        let range = self.parameter.prior();
        let ends = (scale.at(self.parameter.shown(range.low)), scale.at(self.parameter.shown(range.high)));
        vertical_band("prior", ends, (HEAD, self.bottom()))
    }

    /// The value of the direct tests: a line, its spread a band.
    fn direct(&self, scale: &Scale) -> Markup {
        let Some(known) = self.parameter.known(self.ground) else { return html! {} };
        let at = |si: f64| scale.at(self.parameter.shown(si));
        let (low, high) = known.range();
        let middle = at(known.middle());
        let anchor = if middle - self.left() < 70.0 {
            Anchor::Start
        } else if self.left() + PLOT - middle < 70.0 {
            Anchor::End
        } else {
            Anchor::Middle
        };
        html! {
            (vertical_band("direct-band", (at(low), at(high)), (HEAD, self.bottom())))
            (line("direct", (middle, HEAD - 5.0), (middle, self.bottom())))
            (text("direct-label", (middle, HEAD - 10.0), anchor,
                &format!("direct tests {}", self.parameter.knowledge(known))))
        }
    }

    fn row(&self, scale: &Scale, row: &EstimateRow, y: f64) -> Markup {
        let together = row.kind != RowKind::Wheel;
        html! {
            @if together && self.first_together() == Some(row.label.as_str()) {
                (line("divide", (0.0, y - 0.5 * LINE), (self.left() + PLOT, y - 0.5 * LINE)))
            }
            @if self.labelled {
                (text(if together { "label strong" } else { "label" }, (self.left() - 10.0, y + 4.0), Anchor::End,
                    &row.label))
            }
            @match &row.estimate {
                Ok(soil) => (self.bars(scale, (soil, row.is_explained), y, together)),
                Err(reason) => (text("refused", (self.left() + 6.0, y + 4.0), Anchor::Start, reason)),
            }
        }
    }

    fn first_together(&self) -> Option<&str> {
        self.rows.iter().find(|row| row.kind != RowKind::Wheel).map(|row| row.label.as_str())
    }

    /// The 95 % interval thin, the 68 % interval thick, the value a dot: hollow where the data cannot tell it.
    fn bars(&self, scale: &Scale, (soil, is_explained): (&SoilEstimate, bool), y: f64, together: bool) -> Markup {
        let estimate = self.parameter.of(soil);
        let at = |si: f32| scale.at(self.parameter.shown(si.into()));
        let verdict = Verdict::of(self.parameter, soil, self.ground, is_explained);
        let class = verdict.class();
        let bar = |thickness: &str, interval: [f32; 2]| {
            line(&format!("{thickness} {class}"), (at(interval[0]), y), (at(interval[1]), y))
        };
        let radius = if together { 5.0 } else { 4.0 };
        let place = (at(estimate.value), y);
        html! {
            g {
                title { (self.bar_in_words(soil, is_explained)) }
                (bar("thin", estimate.interval_95))
                (bar("thick", estimate.interval_68))
                @if verdict != Verdict::Untold { (dot(class, place, radius)) } @else { (ring(class, place, radius)) }
            }
        }
    }

    fn bar_in_words(&self, soil: &SoilEstimate, is_explained: bool) -> String {
        let parameter = self.parameter;
        let estimate = parameter.of(soil);
        format!(
            "{}; 68 %: {}; 95 %: {}; {}",
            parameter.quantity(estimate.value.into()),
            parameter.interval(estimate.interval_68),
            parameter.interval(estimate.interval_95),
            Verdict::of(parameter, soil, self.ground, is_explained).in_words()
        )
    }

    fn in_words(&self) -> String {
        let parameter = self.parameter;
        let known = parameter.known(self.ground).map(|known| format!("Direct tests: {}. ", parameter.knowledge(known)));
        let rows = self.rows.iter().filter_map(|row| {
            let estimate = row.estimate.as_ref().ok()?;
            Some(format!("{}: {}", row.label, self.bar_in_words(estimate, row.is_explained)))
        });
        let rows: Vec<String> = rows.collect();
        format!("{} in {}. {}{}.", parameter.name(), parameter.unit(), known.unwrap_or_default(), rows.join(". "))
    }
}
