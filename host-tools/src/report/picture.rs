//! The key picture as an SVG file of its own.

use maud::{Markup, PreEscaped, html};

use super::draw::px;
use super::estimates::Panel;
use super::findings::Findings;
use super::page::DRAW_CSS;
use crate::parameter::Parameter;

const GAP: f64 = 8.0;
const BORDER: f64 = 14.0;

/// The three panels side by side, of the first run that has an estimate; none where no run has one.
pub fn picture(findings: &Findings) -> Option<String> {
    let run = findings.identification.runs.iter().find(|run| run.refused().is_none())?;
    let rows = Findings::rows(run);
    let panels: Vec<Panel<'_>> = Parameter::ALL
        .into_iter()
        .enumerate()
        .map(|(place, parameter)| Panel {
            parameter,
            rows: &rows,
            ground: &findings.campaign.ground,
            labelled: place == 0,
        })
        .collect();
    let width = panels.iter().map(|panel| panel.width() + GAP).sum::<f64>() - GAP + 2.0 * BORDER;
    let height = panels.iter().map(Panel::height).fold(0.0, f64::max) + 2.0 * BORDER;
    let mut left = BORDER;
    let placed: Vec<(f64, &Panel<'_>)> = panels
        .iter()
        .map(|panel| {
            let place = left;
            left += panel.width() + GAP;
            (place, panel)
        })
        .collect();
    let name = &findings.campaign.name;
    let svg: Markup = html! {
        svg xmlns="http://www.w3.org/2000/svg" class="picture" width=(px(width)) height=(px(height))
            viewBox={ "0 0 " (px(width)) " " (px(height)) } role="img" aria-label={ "Estimated soil: " (name) } {
            style { (PreEscaped(DRAW_CSS)) }
            rect class="paper" width="100%" height="100%" {}
            @for (left, panel) in placed {
                g transform={ "translate(" (px(left)) " " (px(BORDER)) ")" } { (panel.draw()) }
            }
        }
    };
    Some(svg.into_string() + "\n")
}
