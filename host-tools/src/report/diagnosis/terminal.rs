//! The diagnosis in lines for the terminal.

use comfy_table::Table;

use super::figures::{beside_noise, change, probability, significant, with_std};
use super::findings::DiagnosisFindings;
use super::laws::{declared, parameters};
use super::quantity::Quantity;
use crate::diagnose::document::{Candidate, Diagnosis, ErrorPair};
use crate::report::terminal::wrapped;
use crate::terminal_table::{align_right, plain_table};

/// So many candidates are listed.
const LISTED: usize = 5;

/// The verdict, errors before and after, the best candidates, what is left unexplained, and the caveats.
pub fn terminal(findings: &DiagnosisFindings) -> String {
    let diagnosis = &findings.diagnosis;
    let mut text = format!("{} · {}\n\n{}", diagnosis.campaign, findings.provenance, wrapped("", &diagnosis.sentence));
    for effect in &diagnosis.effects {
        text += &wrapped(" ", &format!("{}: {}", effect.id, parameters(effect)));
    }
    for effect in diagnosis.declared_effects.iter().filter(|effect| !effect.parameters.is_empty()) {
        text += &wrapped(" ", &format!("declared {}", declared(effect)));
    }
    if let Some(measurement) = &diagnosis.deciding_measurement {
        text += &wrapped(" ", &format!("what would decide: {measurement}"));
    }
    text += &format!("\nroot mean square error on held-out runs\n{}\n", errors(diagnosis));
    if !diagnosis.candidates.is_empty() {
        text += &format!(
            "\ncandidates as they are preferred, gain on held-out runs in nats a row\n{}\n",
            candidates(diagnosis)
        );
    }
    text += &by_themselves(diagnosis);
    text += &left(diagnosis);
    text += "\n";
    for caveat in &diagnosis.caveats {
        text += &wrapped("• ", caveat);
    }
    for left_out in &diagnosis.left_out {
        text += &wrapped("• ", &format!("Rows not used: {}, {}.", left_out.rows, left_out.reason));
    }
    text
}

fn errors(diagnosis: &Diagnosis) -> Table {
    let mut table = plain_table();
    let mut head = vec!["", "noise", "before", "after", "", "runs"];
    let levels = diagnosis.leave_level_out.as_ref();
    if levels.is_some() {
        head.extend(["slip level left out: before", "after"]);
    }
    table.set_header(head);
    for (name, errors) in &diagnosis.channels {
        let quantity = Quantity::of_column(name);
        let noise = errors.noise_of_error();
        let shown = |value: f64| beside_noise(quantity.factor * value, quantity.factor * noise);
        let of_pair = |pair: ErrorPair| {
            let change = change(pair.rmse_before, pair.rmse_after);
            [shown(pair.rmse_before), shown(pair.rmse_after), change]
        };
        let [before, after, change] = errors.pair().map_or_else(|| [(); 3].map(|()| "–".to_owned()), of_pair);
        let mut cells = vec![quantity.titled(), shown(noise), before, after, change, errors.runs.to_string()];
        if let Some(pair) = levels.and_then(|levels| levels.channels.get(name)) {
            cells.extend([shown(pair.rmse_before), shown(pair.rmse_after)]);
        }
        table.add_row(cells);
    }
    if let Some(ends) = &diagnosis.ends_apart {
        for (part, channels) in [("ends", &ends.ends), ("between", &ends.between)] {
            for (name, errors) in &diagnosis.channels {
                let Some(pair) = channels.get(name) else { continue };
                let quantity = Quantity::of_column(name);
                let noise = quantity.factor * errors.noise_of_error();
                let shown = |value: f64| beside_noise(quantity.factor * value, noise);
                let change = change(pair.rmse_before, pair.rmse_after);
                let title = format!("{}, {part}", quantity.titled());
                table.add_row([title, String::new(), shown(pair.rmse_before), shown(pair.rmse_after), change]);
            }
        }
    }
    align_right(&mut table);
    table
}

fn candidates(diagnosis: &Diagnosis) -> Table {
    let mut table = plain_table();
    table.set_header(["", "gain", "±", "p", "form"]);
    let of_first = diagnosis.candidates.iter().filter(|candidate| candidate.step == 1);
    for candidate in of_first.take(LISTED) {
        let Candidate { id, form, gain_per_row, gain_std, p_value, .. } = candidate;
        let p_value = p_value.map_or_else(|| "–".to_owned(), probability);
        table.add_row([id.clone(), significant(*gain_per_row, 2), significant(*gain_std, 2), p_value, form.clone()]);
    }
    align_right(&mut table);
    table
}

fn by_themselves(diagnosis: &Diagnosis) -> String {
    if diagnosis.force_channels.is_empty() {
        return String::new();
    }
    let mut text = String::from("\nforce channels by themselves: no model of wheel and soil, braking rows too\n");
    for effect in &diagnosis.force_channels {
        let line = format!(
            "{}, {}: {}, gain {}, p = {}",
            effect.id,
            effect.form,
            parameters(effect),
            significant(effect.gain_per_row, 2),
            probability(effect.p_value)
        );
        text += &wrapped(" ", &line);
    }
    text
}

fn left(diagnosis: &Diagnosis) -> String {
    let mut text = String::from("\n");
    if diagnosis.unexplained.is_empty() {
        text += "nothing is left that follows any column beyond chance\n";
    }
    for entry in &diagnosis.unexplained {
        let follows = if entry.is_along_runs() { "changes along runs with" } else { "follows" };
        let line = format!(
            "left unexplained: {} {follows} {} ({} % of its variance, p = {})",
            entry.channel,
            entry.regressor,
            significant(100.0 * entry.share_of_variance, 2),
            probability(entry.p_value)
        );
        text += &wrapped("", &line);
    }
    if let Some(law) = &diagnosis.found_law {
        let line = format!(
            "found, not understood: {} (coefficient {}, gain {} nats a row on held-out runs)",
            law.formula,
            with_std(law.coefficient, 1.0),
            significant(law.gain_per_row, 2)
        );
        text += &wrapped("", &line);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::sample::findings;
    use super::terminal;

    #[test]
    fn the_best_five_and_what_is_left_are_listed() {
        let text = terminal(&findings());
        assert!(text.starts_with(
            "Smooth wheel in dry sand, straight driving (Carnegie Mellon) · measured\n\nThe sinkage grows"
        ));
        for expected in [
            "what would decide: Repeat",
            "−73 %",
            "load-stiffening",
            "side_force_n follows hours_since_zero",
            "found, not understood: side_force_n",
            "Rows not used: 12",
            "force-drift, side force with hours: side_force_n_per_h = 0.23 ± 0.05 N/h, gain 0.47",
        ] {
            assert!(text.contains(expected), "{expected}\n{text}");
        }
        assert!(!text.contains("peak-stress-shift"), "only five");
        assert!(text.lines().all(|line| line.chars().count() <= 110), "{text}");
    }
}
