//! The advice as a table for the terminal.

use comfy_table::Table;

use super::{Observability, assumptions};
use crate::identifiability::advice::{order, percent};
use crate::identifiability::search::Finding;
use crate::parameter::Parameter;
use crate::report::sentence::as_sentence;
use crate::report::terminal::wrapped;
use crate::terminal_table::{align_right, plain_table};

/// The sentence, the table of manoeuvres, and what it rests on.
pub fn terminal(told: &Observability) -> String {
    let mut text = format!("{}, on {}\n\n", told.rover, told.soil);
    text += &wrapped("", &as_sentence(&told.advice.sentence(&told.question)));
    text += "\n";
    for (name, finding) in named(told) {
        text += &wrapped("", &format!("{name}: {}", order(finding)));
    }
    text += &format!("\n{}\n\n", table(told));
    text += "  c, φ, K: one standard deviation, of the value. Cost in seconds of driving.\n\n";
    for assumption in assumptions(told) {
        text += &wrapped("• ", &assumption);
    }
    text
}

/// All manoeuvres, with short names.
pub(super) fn named(told: &Observability) -> Vec<(String, &Finding)> {
    let advice = &told.advice;
    let computed = std::iter::once(&advice.best).chain(&advice.others).enumerate();
    let mut all: Vec<(String, &Finding)> =
        computed.map(|(place, finding)| (format!("{}", place + 1), finding)).collect();
    all.extend(advice.one_leg.iter().map(|finding| ("one leg, same time".to_owned(), finding)));
    all.extend(advice.usual.iter().map(|finding| ("usual, same time".to_owned(), finding)));
    all
}

fn table(told: &Observability) -> Table {
    let mut table = plain_table();
    let headers = ["", "cost", "time, s", "energy, J", "deeper, mm", "c", "φ", "K", "slips", "loads, N"];
    table.set_header(headers);
    for (name, finding) in named(told) {
        table.add_row(cells(told, name, finding));
    }
    if let Some(before) = &told.advice.before {
        let known = Parameter::ALL.map(|target| percent(before.relative(target, &told.question.soil)));
        table.add_row(["before", "", "", "", ""].map(str::to_owned).into_iter().chain(known));
    }
    align_right(&mut table);
    table
}

fn cells(told: &Observability, what: String, finding: &Finding) -> Vec<String> {
    let expense = &finding.expense;
    let mut cells = vec![
        what,
        format!("{:.0}", finding.cost),
        format!("{:.0}", expense.time_s),
        format!("{:.0}", expense.energy_j),
        format!("{:.1}", 1e3 * expense.sinkage_m),
    ];
    cells.extend(Parameter::ALL.map(|target| percent(finding.bound.relative(target, &told.question.soil))));
    cells.push(slips(finding));
    cells.push(loads(finding));
    cells
}

/// Slips front to rear, leg by leg.
pub(super) fn slips(finding: &Finding) -> String {
    of_wheels(finding, |slip, _| crate::report::draw::number(slip, 2, false))
}

/// Loads front to rear, leg by leg.
pub(super) fn loads(finding: &Finding) -> String {
    of_wheels(finding, |_, load_n| format!("{load_n:.0}"))
}

fn of_wheels(finding: &Finding, shown: impl Fn(f64, f64) -> String) -> String {
    let leg = |wheels: [_; 3]| -> String {
        let wheels: [crate::identifiability::steady_drive::SteadyWheel; 3] = wheels;
        wheels
            .map(|wheel| if wheel.response.is_some() { shown(wheel.slip, wheel.load_n) } else { "–".to_owned() })
            .join(" ")
    };
    let legs: Vec<String> = finding.legs.iter().map(|driven| leg(driven.drive.wheels.into_array())).collect();
    legs.join("; ")
}
