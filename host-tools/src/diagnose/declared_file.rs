//! The model that a diagnosis ends with, as a file that trains and flies it.

use std::fmt::Write;

use crate::data::campaign::{Campaign, Knowledge, is_reference};

use super::document::Diagnosis;

/// A TOML file with the declared effects, as the campaign has them and in the form that fits best, and those found, each with its form and
/// its parameters and their spread. A reader ignores everything but `[declared]`. Of an effect that is both, what was found counts: the campaign may have been told of
/// it since this diagnosis.
pub fn declared_file(campaign: &Campaign, diagnosis: &Diagnosis) -> String {
    let mut text = format!(
        "# What `kapvik diagnose` found in: {}\n# {}\n",
        one_line(&diagnosis.campaign),
        one_line(&diagnosis.sentence)
    );
    let is_new = |id: &str| diagnosis.effects.iter().all(|found| found.id != id);
    let declared: Vec<_> = campaign.declared.effects.iter().filter(|effect| is_new(effect.info.id)).collect();
    let found = diagnosis.effects.iter().map(|effect| effect.id.as_str());
    let ids = declared.iter().map(|effect| effect.info.id).chain(found).map(|id| format!("\"{id}\""));
    let ids: Vec<_> = ids.collect();
    // Writing to a text cannot fail.
    let _ = writeln!(text, "[declared]\neffects = [{}]", ids.join(", "));
    for effect in declared {
        let _ = writeln!(text, "[declared.{}]", effect.info.id);
        let fitted = diagnosis.declared_effects.iter().find(|fit| fit.id == effect.info.id);
        let form = effect.form.map(|form| form.name).or(fitted.map(|fit| fit.form.as_str()));
        if let Some(form) = form {
            let _ = writeln!(text, "form = \"{form}\"");
        }
        for (name, known) in &effect.known {
            text += &match known {
                Knowledge::Value { value, std } => parameter(name, *value, *std),
                Knowledge::Between { min, max } => format!("{name} = {{ min = {min:?}, max = {max:?} }}\n"),
            };
        }
        let referred = fitted.into_iter().flat_map(|fit| &fit.parameters);
        for (name, estimate) in
            referred.filter(|(name, _)| is_reference(name) && !effect.known.contains_key(name.as_str()))
        {
            text += &parameter(name, estimate.value, estimate.std);
        }
    }
    for effect in &diagnosis.effects {
        let _ = writeln!(text, "[declared.{}]\nform = \"{}\"", effect.id, effect.form);
        for (name, estimate) in &effect.parameters {
            text += &parameter(name, estimate.value, estimate.std);
        }
    }
    text
}

/// What is known of a parameter, as a line.
fn parameter(name: &str, value: f64, std: f64) -> String {
    format!("{name} = {{ value = {value:?}, std = {std:?} }}\n")
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
