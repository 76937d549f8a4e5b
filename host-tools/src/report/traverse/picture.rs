//! The key pictures of a drive as one SVG file.

use maud::{Markup, PreEscaped, html};

use super::CHART_CSS;
use super::findings::TraverseFindings;
use super::soil_chart::{self, SoilChart};
use super::time_axis::WIDTH;
use super::wheel_chart::{self, WheelChart};
use crate::parameter::Parameter;
use crate::report::draw::px;
use crate::report::page::DRAW_CSS;
use crate::wheel_quantity::WheelQuantity;

const BORDER: f64 = 14.0;
const GAP: f64 = 10.0;
/// What the picture shows of the wheels.
const SHOWN: [WheelQuantity; 2] = [WheelQuantity::ContactAngle, WheelQuantity::DrawbarPull];

/// Contact angles and drawbar pulls of the wheels, then the soil under the rover, over time.
pub fn picture(findings: &TraverseFindings) -> String {
    let wheels = SHOWN.into_iter().map(|shown| (WheelChart(shown).draw(&findings.samples), wheel_chart::HEIGHT));
    let soils = [Parameter::FrictionAngle, Parameter::ShearModulus];
    let soils = soils.map(|parameter| (SoilChart { parameter, findings }.draw(), soil_chart::HEIGHT));
    let mut top = BORDER;
    let placed: Vec<(f64, Markup)> = wheels
        .chain(soils)
        .map(|(chart, height)| {
            let place = top;
            top += height + GAP;
            (place, chart)
        })
        .collect();
    let (width, height) = (px(WIDTH + 2.0 * BORDER), px(top - GAP + BORDER));
    let words = format!("Estimates along {}", findings.name());
    let svg = html! {
        svg xmlns="http://www.w3.org/2000/svg" class="picture" width=(width) height=(height)
            viewBox={ "0 0 " (width) " " (height) } role="img" aria-label=(words) {
            style { (PreEscaped(DRAW_CSS)) (PreEscaped(CHART_CSS)) }
            rect class="paper" width="100%" height="100%" {}
            @for (top, chart) in placed {
                g transform={ "translate(" (px(BORDER)) " " (px(top)) ")" } { (chart) }
            }
        }
    };
    svg.into_string() + "\n"
}
