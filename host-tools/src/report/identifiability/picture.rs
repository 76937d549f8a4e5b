//! The map of identifiability as an SVG: a row of panels for each number of wheels, a column for each parameter.

use maud::{Markup, PreEscaped, html};

use super::{MAP_CSS, Observability};
use crate::digits::counted;
use crate::identifiability::advice::percent;
use crate::identifiability::map::{Cell, DESIGNS, GREATEST_LOAD_SHARE, GREATEST_SLIP_SPREAD, LOAD_CELLS, SLIP_CELLS};
use crate::identifiability::spread::WheelsInTurn;
use crate::parameter::Parameter;
use crate::report::draw::{Anchor, Scale, line, px, text, vertical_band};
use crate::report::page::DRAW_CSS;

const PANEL_WIDTH: f64 = 220.0;
const PANEL_HEIGHT: f64 = 104.0;
const GAP_X: f64 = 22.0;
const GAP_Y: f64 = 14.0;
const LEFT: f64 = 164.0;
const TOP: f64 = 66.0;
const BELOW: f64 = 92.0;
const RIGHT: f64 = 16.0;

/// Averaging times that colours begin to change at, s, with their names.
const CLASSES: [(f64, &str); 5] =
    [(1.0, "1 s"), (10.0, "10 s"), (60.0, "1 min"), (600.0, "10 min"), (3600.0, "1 hour")];
const NEVER: &str = "not by averaging for an hour";

/// The map.
pub fn picture(told: &Observability) -> String {
    let width = LEFT + 3.0 * PANEL_WIDTH + 2.0 * GAP_X + RIGHT;
    let rows = DESIGNS.len() as f64;
    let bottom = TOP + rows * PANEL_HEIGHT + (rows - 1.0) * GAP_Y;
    let height = bottom + BELOW;
    let accuracy = 100.0 * told.map_question.accuracy;
    let title = format!("Averaging time until c, φ and K are known to {accuracy:.0} %");
    let svg: Markup = html! {
        svg xmlns="http://www.w3.org/2000/svg" class="picture" width=(px(width)) height=(px(height))
            viewBox={ "0 0 " (px(width)) " " (px(height)) } role="img" aria-label=(title) {
            style { (PreEscaped(DRAW_CSS)) (PreEscaped(MAP_CSS)) }
            rect class="paper" width="100%" height="100%" {}
            (text("title", (14.0, 24.0), Anchor::Start, &format!("{title}, on {}", told.soil)))
            @for (column, target) in Parameter::ALL.into_iter().enumerate() {
                (text("label strong", (left_of(column) + 0.5 * PANEL_WIDTH, TOP - 10.0), Anchor::Middle, &named(told, target)))
                @for row in 0..DESIGNS.len() { (panel(told, target, (column, row))) }
            }
            @for (row, design) in DESIGNS.iter().enumerate() {
                (text("label strong", (14.0, top_of(row) + 14.0), Anchor::Start, &counted(design.wheels as u64, "wheel", "wheels")))
                (text("tick", (14.0, top_of(row) + 30.0), Anchor::Start, &stations(design)))
            }
            (text("label", (left_of(1) + 0.5 * PANEL_WIDTH, bottom + 36.0), Anchor::Middle,
                "spread of slip among the stations, greatest less least"))
            g transform={ "translate(" (px(LEFT - 30.0)) " " (px(0.5 * (TOP + bottom))) ") rotate(-90)" } {
                (text("label", (0.0, 0.0), Anchor::Middle, "spread of load, ± % of the mean"))
            }
            (key(bottom + 62.0))
        }
    };
    svg.into_string() + "\n"
}

fn left_of(column: usize) -> f64 {
    LEFT + column as f64 * (PANEL_WIDTH + GAP_X)
}

fn top_of(row: usize) -> f64 {
    TOP + row as f64 * (PANEL_HEIGHT + GAP_Y)
}

fn stations(design: &WheelsInTurn) -> String {
    match design.stations_each {
        1 => "one station each".to_owned(),
        count => format!("{count} stations in turn"),
    }
}

fn named(told: &Observability, target: Parameter) -> String {
    let soil = &told.map_question.soil;
    match target {
        Parameter::Cohesion => format!("cohesion c = {:.0} Pa", soil.cohesion_pa),
        Parameter::FrictionAngle => format!("friction angle φ = {:.1}°", soil.friction_angle_rad.to_degrees()),
        Parameter::ShearModulus => format!("shear modulus K = {:.1} mm", 1e3 * soil.shear_modulus_m),
    }
}

/// Which colour a time has.
fn class(time_s: Option<f64>) -> usize {
    let beyond = CLASSES.len();
    time_s.map_or(beyond, |time_s| CLASSES.iter().position(|(limit, _)| time_s <= *limit).unwrap_or(beyond))
}

fn panel(told: &Observability, target: Parameter, (column, row): (usize, usize)) -> Markup {
    let (left, top) = (left_of(column), top_of(row));
    let across = Scale::linear(0.0, GREATEST_SLIP_SPREAD, (left, left + PANEL_WIDTH));
    let up = Scale::linear(0.0, 100.0 * GREATEST_LOAD_SHARE, (top + PANEL_HEIGHT, top));
    let classes =
        |cells: &[Cell]| -> Vec<usize> { cells.iter().map(|cell| class(*cell.times_s[row].of(target))).collect() };
    html! {
        @for (place, cells) in told.map.chunks(SLIP_CELLS).enumerate() {
            @let edge = |step: usize| 100.0 * GREATEST_LOAD_SHARE * step as f64 / LOAD_CELLS as f64;
            @for (class, from, to) in runs(&classes(cells)) {
                @let x = |cell: usize| across.at(GREATEST_SLIP_SPREAD * cell as f64 / SLIP_CELLS as f64);
                (vertical_band(&format!("t{class}"), (x(from), x(to)), (up.at(edge(place + 1)), up.at(edge(place)))))
            }
        }
        @if told.map.iter().all(|cell| cell.times_s[row].of(target).is_none()) {
            @let best = told.map.iter().map(|cell| *cell.at_last[row].of(target)).fold(f64::INFINITY, f64::min);
            (text("tick", (left + 0.5 * PANEL_WIDTH, top + 0.5 * PANEL_HEIGHT + 4.0), Anchor::Middle,
                &format!("at best {} after an hour", percent(best))))
        }
        rect class="frame" x=(px(left)) y=(px(top)) width=(px(PANEL_WIDTH)) height=(px(PANEL_HEIGHT)) {}
        @if row + 1 == DESIGNS.len() {
            @for tick in [0.0, 0.1, 0.2, 0.3, 0.4, 0.5] {
                (line("axis", (across.at(tick), top + PANEL_HEIGHT), (across.at(tick), top + PANEL_HEIGHT + 4.0)))
                (text("tick", (across.at(tick), top + PANEL_HEIGHT + 17.0), Anchor::Middle, &format!("{tick}")))
            }
        }
        @if column == 0 {
            @for tick in [0.0, 20.0, 40.0] {
                (line("axis", (left - 4.0, up.at(tick)), (left, up.at(tick))))
                (text("tick", (left - 7.0, up.at(tick) + 4.0), Anchor::End, &format!("{tick}")))
            }
        }
    }
}

/// Runs of equal classes: class, first cell, cell after the last.
fn runs(classes: &[usize]) -> Vec<(usize, usize, usize)> {
    let mut runs: Vec<(usize, usize, usize)> = Vec::new();
    for (place, class) in classes.iter().enumerate() {
        match runs.last_mut() {
            Some((known, _, to)) if known == class => *to = place + 1,
            _ => runs.push((*class, place, place + 1)),
        }
    }
    runs
}

fn key(top: f64) -> Markup {
    let step = 98.0;
    let names = CLASSES.iter().map(|(_, name)| format!("up to {name}")).chain([NEVER.to_owned()]);
    html! {
        @for (class, name) in names.enumerate() {
            @let left = LEFT + class as f64 * step;
            rect class={ "legend-box t" (class) } x=(px(left)) y=(px(top)) width="16" height="12" {}
            (text("tick", (left + 22.0, top + 10.0), Anchor::Start, &name))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{class, runs};

    #[test]
    fn times_have_the_colour_of_their_class() {
        let times = [Some(1.0), Some(1.1), Some(60.0), Some(3600.0), None];
        assert_eq!(times.map(class), [0, 1, 2, 4, 5]);
    }

    #[test]
    fn neighbours_of_one_class_are_drawn_as_one() {
        assert_eq!(runs(&[5, 5, 2, 2, 2, 5]), [(5, 0, 2), (2, 2, 5), (5, 5, 6)]);
    }
}
