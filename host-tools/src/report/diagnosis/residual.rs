//! What is left over, against the column that it follows.

use maud::{Markup, html};

use super::findings::{DiagnosisFindings, Side};
use super::pair::{Pair, span, stride};
use super::quantity::Quantity;
use crate::diagnose::Trace;
use crate::report::draw::{Scale, dot, line, path, vertical_band};
use crate::report::legend::entry;

/// At most so many points has a line of means.
const GROUPS: usize = 8;

/// One row: where it is along the column, its residuals before and after in standard deviations, and its run.
struct Left<'a> {
    along: f64,
    residuals: [Option<f64>; 2],
    run: &'a str,
}

/// The plots of all channels against a column; none where it is not among the columns.
pub fn charts(findings: &DiagnosisFindings, column: &str) -> Option<Markup> {
    let along = findings.column(column)?;
    Some(html! {
        @for trace in &findings.traces { (chart(findings, trace, column, &along)) }
        (legend())
    })
}

fn chart(findings: &DiagnosisFindings, trace: &Trace, column: &str, along: &[Option<f64>]) -> Markup {
    let guilty = Quantity::of_column(column);
    let used = trace.rows.iter().zip(along).zip(&findings.runs);
    let rows: Vec<Left<'_>> = used
        .filter_map(|((row, along), run)| {
            let row = (*row)?;
            let residuals = Side::BOTH.map(|side| row.residual(side));
            Some(Left { along: guilty.factor * (*along)?, residuals, run })
        })
        .collect();
    let x = span(rows.iter().map(|row| row.along));
    let extent = rows.iter().flat_map(|row| row.residuals).flatten().chain([-2.0, 2.0]);
    let (Some(x), Some(y)) = (x, span(extent)) else { return html! {} };
    let title = format!("{}: measured − predicted, in standard deviations", Quantity::of_column(&trace.channel).name);
    let captions = [findings.before_in_words(), findings.after_in_words()];
    Pair { title: &title, along: &guilty.titled(), x, y, captions }.svg(|side, x, y| side_of(side, &rows, x, y))
}

fn side_of(side: Side, rows: &[Left<'_>], x: &Scale, y: &Scale) -> Markup {
    let (left, right) = x.pixels();
    let points: Vec<(f64, f64, &str)> =
        rows.iter().filter_map(|row| Some((row.along, side.of(row.residuals)?, row.run))).collect();
    let means: Vec<(f64, f64)> = means(&points).into_iter().map(|(along, mean)| (x.at(along), y.at(mean))).collect();
    html! {
        @for deviations in [2.0, 1.0] {
            (vertical_band("expected", (left, right), (y.at(deviations), y.at(-deviations))))
        }
        (line("axis", (left, y.at(0.0)), (right, y.at(0.0))))
        @for (along, residual, run) in points.iter().step_by(stride(points.len())) {
            g { title { (run) } (dot(&format!("left {}", side.class()), (x.at(*along), y.at(*residual)), 2.8)) }
        }
        @if means.len() > 1 { (path(&format!("mean {}", side.class()), &means)) }
    }
}

/// Means over neighbours along the column: groups of like size, and rows at one place are never parted.
fn means(points: &[(f64, f64, &str)]) -> Vec<(f64, f64)> {
    let mut sorted: Vec<(f64, f64)> = points.iter().map(|(along, residual, _)| (*along, *residual)).collect();
    sorted.sort_by(|one, other| one.0.total_cmp(&other.0));
    let least = sorted.len().div_ceil(GROUPS).max(1);
    let width = sorted.last().zip(sorted.first()).map_or(0.0, |(last, first)| last.0 - first.0);
    let mut groups: Vec<Vec<(f64, f64)>> = Vec::new();
    for point in sorted {
        match groups.last_mut() {
            // Slips that were commanded alike differ in the third place.
            Some(group) if group.len() < least || group.last().is_some_and(|last| point.0 - last.0 < 2e-3 * width) => {
                group.push(point);
            }
            _ => groups.push(vec![point]),
        }
    }
    let mean = |group: &Vec<(f64, f64)>| {
        let count = group.len() as f64;
        let sum = group.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1));
        (sum.0 / count, sum.1 / count)
    };
    groups.iter().map(mean).collect()
}

fn legend() -> Markup {
    html! {
        ul class="legend" {
            (entry("one row", &html! {
                (dot("left before", (13.0, 8.0), 2.8))
                (dot("left after", (27.0, 8.0), 2.8))
            }))
            (entry("mean over neighbours", &html! {
                (path("mean before", &[(0.0, 5.0), (40.0, 5.0)]))
                (path("mean after", &[(0.0, 11.0), (40.0, 11.0)]))
            }))
            (entry("one and two standard deviations of the noise", &html! {
                (vertical_band("expected", (0.0, 40.0), (0.0, 16.0)))
                (vertical_band("expected", (0.0, 40.0), (4.0, 12.0)))
            }))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::means;

    #[test]
    fn rows_at_one_place_are_never_parted() {
        let points: Vec<(f64, f64, &str)> = (0..27).map(|row| (f64::from(row / 3), f64::from(row % 3), "")).collect();
        let means = means(&points);
        assert!(means.len() <= 9);
        assert!(means.iter().all(|(_, mean)| (mean - 1.0).abs() < 1e-12));
    }
}
