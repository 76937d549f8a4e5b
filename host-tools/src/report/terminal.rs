//! The findings as a table for the terminal.

use comfy_table::Table;
use kapvik_firmware::soil::SoilEstimate;

use super::caveats::caveats;
use super::draw::number;
use super::findings::{EstimateRow, Findings};
use super::residual::ModelCheck;
use super::verdict::Verdict;
use crate::parameter::Parameter;
use crate::terminal_table::{align_right, plain_table};

/// A table of the estimates beside the direct tests, a table of what the equations leave, and the caveats.
pub fn terminal(findings: &Findings) -> String {
    let campaign = &findings.campaign;
    let mut text = format!("{} · {}\n", campaign.name, campaign.provenance);
    for run in &findings.identification.runs {
        if findings.identification.runs.len() > 1 {
            text += &format!("\nrun {}\n", run.states.run);
        }
        match run.refused() {
            Some(reason) => text += &format!("\n  no estimate: {reason}\n"),
            None => text += &format!("\n{}\n", estimates(findings, &Findings::rows(run))),
        }
        if !run.states.rows_left_out.is_empty() && run.question.is_some() {
            text += &format!("  left out: {}\n", run.states.reasons_in_words());
        }
    }
    text += "  value (68 % interval); ? = cannot be told from these data; ! = narrow, but to be doubted\n";
    if let Some(model) = &findings.model {
        text +=
            &format!("\nequations 1–11 with the directly measured soil: measured − computed\n{}\n", residuals(model));
    }
    text += "\n";
    for caveat in caveats(findings) {
        text += &wrapped("• ", &caveat);
    }
    text
}

fn estimates(findings: &Findings, rows: &[EstimateRow]) -> Table {
    let mut table = plain_table();
    let units = Parameter::ALL.map(|parameter| format!("{}, {}", parameter.symbol(), parameter.unit()));
    table.set_header(std::iter::once(String::new()).chain(units));
    for row in rows {
        let cells = Parameter::ALL.map(|parameter| match &row.estimate {
            Ok(soil) => cell(findings, parameter, soil, row.is_explained),
            Err(reason) => (*reason).to_owned(),
        });
        table.add_row(std::iter::once(row.label.clone()).chain(cells));
    }
    let known = Parameter::ALL.map(|parameter| {
        let known = parameter.known(&findings.campaign.ground);
        known.map_or_else(|| "–".to_owned(), |known| parameter.knowledge(known))
    });
    table.add_row(std::iter::once("direct tests".to_owned()).chain(known));
    align_right(&mut table);
    table
}

fn cell(findings: &Findings, parameter: Parameter, soil: &SoilEstimate, is_explained: bool) -> String {
    let estimate = parameter.of(soil);
    let mark = Verdict::of(parameter, soil, &findings.campaign.ground, is_explained).mark();
    format!("{} ({}) {mark}", parameter.number(estimate.value.into()), parameter.interval(estimate.interval_68))
}

fn residuals(model: &ModelCheck) -> Table {
    let mut table = plain_table();
    table.set_header(["", "DP, N", "T, N·m", "z, mm"]);
    for row in &model.rows {
        let slip = format!("slip {}", number(row.slip, 2, false));
        table.add_row(std::iter::once(slip).chain(row.left_over().cells(true)));
    }
    table.add_row(std::iter::once("root mean square".to_owned()).chain(model.rms().cells(false)));
    align_right(&mut table);
    table
}

/// A paragraph with a mark before it, in lines that a terminal can show.
pub(super) fn wrapped(mark: &str, paragraph: &str) -> String {
    const WIDTH: usize = 96;
    let mut text = String::new();
    let mut line = mark.to_owned();
    for (place, word) in paragraph.split_whitespace().enumerate() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            text += &line;
            text.push('\n');
            line = " ".to_owned();
        }
        if place > 0 {
            line.push(' ');
        }
        line += word;
    }
    text + &line + "\n"
}
