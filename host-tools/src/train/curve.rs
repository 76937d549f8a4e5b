//! Validation curves, and their picture.

use std::ops::Range;

use plotters::prelude::*;

use crate::error::HostError;
use crate::statistics::ends;

/// Colours that readers of any sight tell apart (Okabe and Ito 2008).
const COLOURS: [RGBColor; 5] =
    [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(0, 158, 115), RGBColor(204, 121, 167), RGBColor(90, 90, 90)];

/// Loss on held-out cases over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What was trained, and how.
    pub name: String,
    /// Seconds since training began, and mean negative log-likelihood per case (nats, up to a constant).
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// An empty curve.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), points: Vec::new() }
    }

    /// The last loss.
    pub fn last(&self) -> f64 {
        self.points.last().map_or(f64::NAN, |point| point.1)
    }
}

/// Draws curves side by side into one SVG: a panel for each group, seconds on a logarithmic axis.
///
/// # Errors
/// Where the drawing library refuses.
pub fn draw(panels: &[(&str, &[Curve])]) -> Result<String, HostError> {
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (460 * panels.len() as u32, 340)).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        for (area, (title, curves)) in root.split_evenly((1, panels.len())).iter().zip(panels) {
            draw_panel(area, title, curves)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

fn failed<E: std::fmt::Display>(error: E) -> HostError {
    HostError::Failed(format!("the curves could not be drawn: {error}"))
}

/// Seconds and losses that hold the points of all curves, and some more.
fn ranges(curves: &[Curve]) -> (Range<f64>, Range<f64>) {
    let points = || curves.iter().flat_map(|curve| curve.points.iter().copied());
    let (early, late) = ends(points().map(|(seconds, _)| seconds)).unwrap_or((0.05, 0.1));
    let (low, high) = ends(points().map(|(_, loss)| loss)).unwrap_or((0.0, 0.0));
    let margin = 0.05 * (high - low).max(1e-3);
    (early.max(0.05)..late.max(0.1) * 1.05, low - margin..high + margin)
}

fn draw_panel(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    title: &str,
    curves: &[Curve],
) -> Result<(), HostError> {
    let (seconds, losses) = ranges(curves);
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 17))
        .margin(12)
        .x_label_area_size(36)
        .y_label_area_size(52)
        .build_cartesian_2d(seconds.log_scale(), losses)
        .map_err(failed)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_labels(5)
        .x_label_formatter(&|seconds| format!("{seconds}"))
        .x_desc("seconds")
        .y_desc("held-out loss (nats)")
        .label_style(("sans-serif", 12))
        .draw()
        .map_err(failed)?;
    for (curve, colour) in curves.iter().zip(COLOURS) {
        chart
            .draw_series(LineSeries::new(curve.points.iter().copied(), colour.stroke_width(2)))
            .map_err(failed)?
            .label(curve.name.clone())
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2)));
    }
    if curves.len() < 2 {
        return Ok(());
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.85))
        .label_font(("sans-serif", 12))
        .draw()
        .map_err(failed)
}
