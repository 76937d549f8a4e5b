//! The declared model as a file: what the campaign declared, and what was found.

use std::fmt::Write;

use kapvik_firmware::terramechanics::effects::effect_info;

use crate::data::campaign::{Campaign, Knowledge};
use crate::diagnose::document::{Diagnosis, FoundEffect};
use crate::error::HostError;

/// The text of a file with a table `[declared]`: the campaign's effects, and those that were found with the values and
/// standard deviations of the fit. An effect that was found takes the place of one of the same id that was declared.
///
/// # Errors
/// Where the diagnosis names an effect or a parameter that there is not.
pub fn declared_model(campaign: &Campaign, diagnosis: &Diagnosis) -> Result<String, HostError> {
    let mut sections: Vec<(&str, String)> = Vec::new();
    for declared in &campaign.declared.effects {
        let mut section = String::new();
        if let Some(form) = declared.form {
            line(&mut section, "form", &format!("{:?}", form.name));
        }
        for (name, known) in &declared.known {
            line(&mut section, name, &in_toml(*known));
        }
        sections.push((declared.info.id, section));
    }
    for found in &diagnosis.effects {
        sections.retain(|(id, _)| *id != found.id);
        sections.push((&found.id, section(found)?));
    }
    let ids: Vec<String> = sections.iter().map(|(id, _)| format!("{id:?}")).collect();
    let found: Vec<&str> = diagnosis.effects.iter().map(|effect| effect.id.as_str()).collect();
    let mut text = format!(
        "# The model that was declared for the campaign {}, and what was found in it: {}.\n\n[declared]\neffects = [{}]\n",
        in_a_line(&diagnosis.campaign),
        if found.is_empty() { "nothing".to_owned() } else { found.join(", ") },
        ids.join(", ")
    );
    for (id, section) in sections.iter().filter(|(_, section)| !section.is_empty()) {
        text += &format!("\n[declared.{id}]\n{section}");
    }
    Ok(text)
}

fn section(found: &FoundEffect) -> Result<String, HostError> {
    let refuse = |what: String| HostError::Failed(format!("the diagnosis found {}: {what}", found.id));
    let info = effect_info(&found.id).ok_or_else(|| refuse("there is no effect of that id".into()))?;
    let mut section = String::new();
    if info.forms.iter().any(|form| form.name == found.form) {
        line(&mut section, "form", &format!("{:?}", found.form));
    }
    for (name, estimate) in &found.parameters {
        let parameter = info.parameter(name).ok_or_else(|| refuse(format!("it has no parameter `{name}`")))?;
        let value = estimate.value.clamp(parameter.low, parameter.high);
        line(&mut section, name, &in_toml(Knowledge::Value { value, std: estimate.std }));
    }
    Ok(section)
}

fn line(section: &mut String, key: &str, value: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(section, "{key} = {value}");
}

fn in_toml(known: Knowledge) -> String {
    match known {
        // `{:?}` keeps the point of a float and reads back to the same bits.
        Knowledge::Value { value, std: 0.0 } => format!("{value:?}"),
        Knowledge::Value { value, std } => format!("{{ value = {value:?}, std = {std:?} }}"),
        Knowledge::Between { min, max } => format!("{{ min = {min:?}, max = {max:?} }}"),
    }
}

/// A name that cannot end a comment.
fn in_a_line(name: &str) -> String {
    name.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::close_loop::tests::{campaign, diagnosis};
    use crate::data::campaign::Declared;

    #[test]
    fn the_file_reads_back_to_what_was_declared_and_found() {
        let campaign = campaign(
            "effects = [\"guide-friction\", \"force-bias\"]\n[declared.force-bias]\nload_n = { min = -1, max = 2 }\n",
        );
        let text = declared_model(&campaign, &diagnosis()).expect("a model");
        let read = Declared::parse(Path::new("declared.toml"), &text).expect("what was written");
        assert_eq!(read.ids(), ["guide-friction", "force-bias", "slip-sinkage"]);
        assert_eq!(read.effects[..2], campaign.declared.effects[..]);
        let found = &read.effects[2];
        assert_eq!(found.form.map(|form| form.name), Some("exponent"));
        assert_eq!(found.known.get("n1"), Some(&Knowledge::Value { value: 0.3, std: 0.03 }));
    }

    #[test]
    fn what_is_found_takes_the_place_of_what_was_declared() {
        let campaign = campaign("effects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nstretch = 0.5\n");
        let text = declared_model(&campaign, &diagnosis()).expect("a model");
        let read = Declared::parse(Path::new("declared.toml"), &text).expect("what was written");
        assert_eq!(read.ids(), ["slip-sinkage"]);
        assert_eq!(read.effects[0].known.keys().copied().collect::<Vec<_>>(), ["n1"]);
    }

    #[test]
    fn an_effect_that_there_is_not_is_an_error() {
        let mut diagnosis = diagnosis();
        diagnosis.effects[0].id = "slip-sinking".to_owned();
        let error = declared_model(&campaign("effects = []\n"), &diagnosis).expect_err("an error").to_string();
        assert!(error.contains("slip-sinking"), "{error}");
    }
}
