//! Measured and computed forces and sinkage over slip.

use kapvik_firmware::terramechanics::{Soil, Wheel};
use maud::{Markup, html};

use super::draw::{Anchor, Scale, bottom_axis, dot, left_axis, line, path, px, text};
use super::residual::{ModelCheck, ModelRow, ModelState};

const WIDTH: f64 = 330.0;
const HEIGHT: f64 = 214.0;
const LEFT: f64 = 40.0;
const RIGHT: f64 = WIDTH - 12.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = HEIGHT - 38.0;
/// Points of a curve.
const POINTS: usize = 60;

/// What is drawn over slip.
pub struct Response<'a> {
    /// Measurements and the directly measured soil.
    pub check: &'a ModelCheck,
    /// The wheel.
    pub wheel: &'a Wheel<f64>,
    /// The soil of the networks, where there is one.
    pub estimated: Option<&'a Soil<f64>>,
}

/// One quantity over slip.
pub struct SlipCurve {
    title: &'static str,
    unit: &'static str,
    /// From SI units to the shown one.
    factor: f64,
    measured: fn(&ModelRow) -> Option<f64>,
    computed: fn(&ModelState) -> f64,
}

/// Drawbar pull, torque and sinkage.
pub const SLIP_CURVES: [SlipCurve; 3] = [
    SlipCurve {
        title: "Drawbar pull",
        unit: "N",
        factor: 1.0,
        measured: |row| row.drawbar_pull_n,
        computed: |model| model.drawbar_pull_n,
    },
    SlipCurve {
        title: "Torque",
        unit: "N·m",
        factor: 1.0,
        measured: |row| row.torque_nm,
        computed: |model| model.torque_nm,
    },
    SlipCurve {
        title: "Sinkage",
        unit: "mm",
        factor: 1e3,
        measured: |row| row.sinkage_m,
        computed: |model| model.sinkage_m,
    },
];

impl Response<'_> {
    /// The picture of one quantity; `std` is one standard deviation of a measurement, SI.
    pub fn svg(&self, quantity: &SlipCurve, std: f64) -> Markup {
        let known = self.curve(&self.check.soil, quantity);
        let estimated = self.estimated.map(|soil| self.curve(soil, quantity)).unwrap_or_default();
        let measured: Vec<(f64, f64)> = self
            .check
            .rows
            .iter()
            .filter_map(|row| Some((row.slip, quantity.factor * (quantity.measured)(row)?)))
            .collect();
        let x = Scale::linear(self.slips().0, self.slips().1, (LEFT, RIGHT));
        let deviation = quantity.factor * std;
        let ends = measured.iter().flat_map(|(_, value)| [value - deviation, value + deviation]);
        let all = known.iter().chain(&estimated).map(|(_, value)| *value).chain(ends);
        let y = Scale::around(all, (BOTTOM, TOP));
        let placed = |points: &[(f64, f64)]| -> Vec<(f64, f64)> {
            points.iter().map(|(slip, value)| (x.at(*slip), y.at(*value))).collect()
        };
        let words = format!("{} in {} over slip, measured and computed", quantity.title, quantity.unit);
        html! {
            svg class="panel" viewBox={ "0 0 " (px(WIDTH)) " " (px(HEIGHT)) } role="img" aria-label=(words) {
                text class="title" x=(px(LEFT)) y="16" { (quantity.title) ", " (quantity.unit) }
                (left_axis(&y, (LEFT, RIGHT)))
                (bottom_axis(&x, (TOP, BOTTOM)))
                (text("tick", (0.5 * (LEFT + RIGHT), HEIGHT - 6.0), Anchor::Middle, "slip"))
                (path("estimated", &placed(&estimated)))
                (path("known", &placed(&known)))
                @for (slip, value) in &measured { (measurement(&x, &y, *slip, *value, deviation)) }
            }
        }
    }

    fn slips(&self) -> (f64, f64) {
        let slips = self.check.rows.iter().map(|row| row.slip);
        let (low, high) = slips.fold((0.0, 0.1), |(low, high): (f64, f64), slip| (low.min(slip), high.max(slip)));
        let room = 0.04 * (high - low);
        (low - room, high + room)
    }

    /// At the mean load of the measurements. A slip where the soil does not carry the load is left out.
    fn curve(&self, soil: &Soil<f64>, quantity: &SlipCurve) -> Vec<(f64, f64)> {
        let rows = &self.check.rows;
        let load_n = rows.iter().map(|row| row.load_n).sum::<f64>() / rows.len() as f64;
        let (low, high) = self.slips();
        let slips = (0..=POINTS).map(|point| low + (high - low) * point as f64 / POINTS as f64);
        let value = |slip| {
            Some((slip, quantity.factor * (quantity.computed)(&ModelState::at(self.wheel, soil, slip, load_n)?)))
        };
        slips.filter(|slip| slip.abs() <= 1.0).filter_map(value).collect()
    }
}

/// A dot with its standard deviation up and down.
fn measurement(x: &Scale, y: &Scale, slip: f64, value: f64, std: f64) -> Markup {
    html! {
        (line("deviation", (x.at(slip), y.at(value - std)), (x.at(slip), y.at(value + std))))
        (dot("measured", (x.at(slip), y.at(value)), 3.5))
    }
}
