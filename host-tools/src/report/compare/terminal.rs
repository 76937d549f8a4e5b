//! The comparison as tables for the terminal.

use comfy_table::Table;

use crate::compare::{CONTENDERS, Compared, Comparison, MeasuredRow, ParameterScore, Score};
use crate::parameter::Parameter;
use crate::report::draw::number;
use crate::report::identified::{remark, soil_cells};
use crate::terminal_table::{align_right, plain_table};

use super::error_chart::percent;
use super::verdict::{is_best, to_limit, verdicts};

/// What direct tests of the sand of Ding et al. 2011 found.
pub const DIRECT_TESTS: &str = "c 250 Pa, φ 31.9°, K 9.7–13.1 mm";

/// What the figures are.
const LEGEND: &str = "median of the estimates [quartiles], median size of the error, 68 % and 95 % intervals that hold the truth in %; \
    * = least median error of the methods; ( ) = taken as given";

/// One table for each situation, the measured figures, and what follows.
pub fn terminal(comparison: &Comparison) -> String {
    let mut text = format!("{} cases of each situation, seed {}\n{LEGEND}\n", comparison.cases, comparison.seed);
    for compared in &comparison.situations {
        text += &format!("\n{} — {}\n{}\n", compared.id, compared.title, table(compared));
        if let Some(bound) = compared.cramer_rao {
            text += &format!("  {}\n", cramer_rao(bound));
        }
    }
    if !comparison.measured.is_empty() {
        text += &format!(
            "\none wheel at six slips, measured (Ding et al. 2011); direct tests: {DIRECT_TESTS}\n{}\n",
            measured(&comparison.measured)
        );
    }
    let near = to_limit(comparison);
    if !near.is_empty() {
        text += &format!("\nroot mean square error over that of the limit, on the same cases\n{}\n", limit_table(near));
    }
    text += "\n";
    for verdict in verdicts(comparison) {
        text += &format!("• {verdict}\n");
    }
    text
}

fn table(compared: &Compared) -> Table {
    let mut table = plain_table();
    let of_parameters =
        Parameter::ALL.into_iter().flat_map(|of| [of.titled(), "error".to_owned(), "68, 95".to_owned()]);
    let of_all = ["refused", "time"].map(str::to_owned);
    table.set_header([String::new()].into_iter().chain(of_parameters).chain(of_all));
    for score in &compared.scores {
        let mut row = vec![label(score.contender).to_owned()];
        for parameter in Parameter::ALL {
            row.extend(cells(compared, score, parameter));
        }
        row.push(format!("{} %", percent(score.refused)));
        row.push(duration(score.seconds));
        table.add_row(row);
    }
    align_right(&mut table);
    table
}

/// The bound in words.
pub fn cramer_rao([cohesion, friction, modulus]: [f64; 3]) -> String {
    let figure = |value: f64, digits| number(value, digits, false);
    format!(
        "Cramér–Rao bound without any belief in c, φ and K, one standard deviation: c {} Pa, φ {}°, K {} mm",
        figure(cohesion, 0),
        figure(friction, 1),
        figure(modulus, 1)
    )
}

fn cells(compared: &Compared, score: &Score, parameter: Parameter) -> [String; 3] {
    let of = score.parameter(parameter);
    if of.median.is_nan() {
        return ["–", "", ""].map(str::to_owned);
    }
    let figure = |value: f64| number(value, parameter.decimals(), false);
    if of.assumed {
        return [format!("({})", figure(of.median)), String::new(), String::new()];
    }
    let star = if is_best(compared, score, parameter) { "*" } else { "" };
    [
        format!("{} [{}, {}]", figure(of.median), figure(of.low_quartile), figure(of.high_quartile)),
        format!("{}{star}", figure(of.median_error)),
        coverage(of),
    ]
}

fn coverage(score: &ParameterScore) -> String {
    format!("{}, {}", percent(score.within_68), percent(score.within_95))
}

fn limit_table(rows: Vec<[String; 5]>) -> Table {
    let mut table = plain_table();
    table.set_header(["", "", "c", "φ", "K"]);
    for row in rows {
        table.add_row(row);
    }
    align_right(&mut table);
    table
}

/// The words for a contender.
pub fn label(id: &str) -> &str {
    CONTENDERS.iter().find(|contender| contender.id == id).map_or(id, |contender| contender.label)
}

/// A time that reads well.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.0} µs", 1e6 * s),
        s if s < 1.0 => format!("{:.1} ms", 1e3 * s),
        s => format!("{s:.1} s"),
    }
}

fn measured(rows: &[MeasuredRow]) -> Table {
    let mut table = plain_table();
    let [cohesion, friction, modulus] = Parameter::ALL.map(Parameter::titled);
    table.set_header([String::new(), cohesion, friction, modulus, String::new()]);
    for cells in measured_rows(rows) {
        table.add_row(cells);
    }
    align_right(&mut table);
    table
}

/// The cells of each measured row: method, c, φ, K, and why it refused or is no soil.
pub fn measured_rows(rows: &[MeasuredRow]) -> Vec<[String; 5]> {
    let row = |row: &MeasuredRow| {
        let declared =
            if row.declared.is_empty() { String::new() } else { format!(", told of {}", row.declared.join(", ")) };
        let [cohesion, friction, modulus] = soil_cells(&row.found.soil);
        [format!("{}{declared}", row.method), cohesion, friction, modulus, remark(&row.found)]
    };
    rows.iter().map(row).collect()
}
