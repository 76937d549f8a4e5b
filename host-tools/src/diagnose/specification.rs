//! Which effects a model has, and which of their parameters are free.

use std::collections::BTreeMap;

use kapvik_firmware::terramechanics::effects::{EffectInfo, Effects, Form, ParameterInfo, Role};

use crate::data::campaign::{Campaign, DeclaredEffect, Knowledge};

use super::fit::{Coordinate, Reading};
use super::measurements::{Measurements, median};
use super::plausible_range::plausible_range;

/// Combinations of forms that are tried at most: each is a fit from several starts.
const MOST_COMBINATIONS: usize = 256;

/// The effects of a model, in the order in which they came in.
#[derive(Debug, Clone, Default)]
pub struct Specification {
    /// The effects.
    pub effects: Vec<EffectForm>,
}

/// An effect in one of its forms.
#[derive(Debug, Clone)]
pub struct EffectForm {
    /// The effect.
    pub info: &'static EffectInfo,
    /// Its form.
    pub form: &'static Form,
    /// What is known of its parameters beforehand.
    pub known: BTreeMap<&'static str, Knowledge>,
}

/// A parameter of an effect that a fit frees.
#[derive(Debug, Clone)]
pub struct FreeParameter {
    /// The effect's id.
    pub id: &'static str,
    /// The parameter's name.
    pub parameter: &'static str,
    /// As the fit sees it.
    pub coordinate: Coordinate,
}

impl Specification {
    /// What a campaign declares: every combination of the forms that its declared effects may have.
    ///
    /// # Errors
    /// How many those are, where they are more than anybody waits for.
    pub fn declared(campaign: &Campaign, measured: impl Fn(&Form) -> bool) -> Result<Vec<Self>, usize> {
        let effects = &campaign.declared.effects;
        let forms: Vec<_> = effects.iter().map(|declared| possible_forms(declared, &measured)).collect();
        let combinations = forms.iter().map(Vec::len).fold(1, usize::saturating_mul);
        if combinations > MOST_COMBINATIONS {
            return Err(combinations);
        }
        let mut found = vec![Self::default()];
        for (declared, forms) in effects.iter().zip(&forms) {
            let with = |form| EffectForm { info: declared.info, form, known: declared.known.clone() };
            found = forms.iter().flat_map(|form| found.iter().map(|spec| spec.with(with(form)))).collect();
        }
        Ok(found)
    }

    /// The same with one more effect.
    pub fn with(&self, effect: EffectForm) -> Self {
        let mut effects = self.effects.clone();
        effects.push(effect);
        Self { effects }
    }

    /// An effect, if it is among them.
    pub fn effect(&self, id: &str) -> Option<&EffectForm> {
        self.effects.iter().find(|effect| effect.info.id == id)
    }

    /// Whether an effect is among them.
    pub fn has(&self, id: &str) -> bool {
        self.effect(id).is_some()
    }

    /// Id and form of each, in order.
    pub fn names(&self) -> Vec<(&'static str, &'static str)> {
        self.effects.iter().map(EffectForm::name).collect()
    }

    /// The effects with what is fixed set, and the parameters that are free.
    pub fn effects(&self, measurements: &Measurements) -> (Effects<f64>, Vec<FreeParameter>) {
        let (mut effects, mut free) = (Effects::none(), Vec::new());
        for effect in &self.effects {
            effects.add(effect.info.id);
            for parameter in effect.info.parameters {
                match effect.treatment(parameter, measurements) {
                    Ok(value) => {
                        effects.set(effect.info.id, parameter.name, value);
                    }
                    Err(coordinate) => {
                        free.push(FreeParameter { id: effect.info.id, parameter: parameter.name, coordinate });
                    }
                }
            }
        }
        (effects, free)
    }
}

impl EffectForm {
    /// An effect of which nothing is known.
    pub fn new(info: &'static EffectInfo, form: &'static Form) -> Self {
        Self { info, form, known: BTreeMap::new() }
    }

    /// An effect in each of its forms, nothing known of it.
    pub fn each_of(info: &'static EffectInfo) -> impl Iterator<Item = Self> {
        info.forms.iter().map(move |form| Self::new(info, form))
    }

    /// Id and form, which no two share.
    pub fn name(&self) -> (&'static str, &'static str) {
        (self.info.id, self.form.name)
    }

    /// The parameters that are not free and yet not left alone, with their values: what is known exactly, what the form sets, and what others
    /// refer to.
    pub fn held(&self, measurements: &Measurements) -> Vec<(&'static str, f64)> {
        let is_left_alone = |parameter: &ParameterInfo| {
            let name = parameter.name;
            !self.known.contains_key(name) && !self.form.has(name) && reference(name, measurements).is_none()
        };
        let parameters = self.info.parameters.iter().filter(|parameter| !is_left_alone(parameter));
        parameters
            .filter_map(|parameter| Some((parameter.name, self.treatment(parameter, measurements).ok()?)))
            .collect()
    }

    /// The value at which a parameter is held, or how a fit sees it.
    fn treatment(&self, parameter: &ParameterInfo, measurements: &Measurements) -> Result<f64, Coordinate> {
        let coordinate =
            |low, high, start, prior| Coordinate { name: parameter.name.to_owned(), low, high, start, prior };
        match self.known.get(parameter.name) {
            Some(Knowledge::Value { value, std }) if *std == 0.0 => return Ok(*value),
            Some(Knowledge::Value { value, std }) => {
                return Err(coordinate(parameter.low, parameter.high, *value, Some((*value, *std))));
            }
            Some(Knowledge::Between { min, max }) => return Err(coordinate(*min, *max, 0.5 * (min + max), None)),
            None => {}
        }
        let set = self.form.set.iter().find(|(name, _)| *name == parameter.name).map(|(_, value)| *value);
        let reference = reference(parameter.name, measurements);
        if self.form.free.contains(&parameter.name) {
            let start = set.or(reference).unwrap_or_else(|| self.start(parameter));
            let expected = (parameter.role == Role::Shape).then_some((parameter.neutral, parameter.typical));
            let (low, high) = plausible_range(self.info, parameter, measurements);
            return Err(coordinate(low, high, start.clamp(low, high), expected));
        }
        Ok(set.or(reference).unwrap_or(parameter.neutral))
    }

    /// Where a search for a free parameter starts: a little off neutral where the parameter can grow to both sides and is the
    /// form's first, so that the first step finds its sign; else at a typical size.
    fn start(&self, parameter: &ParameterInfo) -> f64 {
        let first = self.form.free.first() == Some(&parameter.name);
        let inside = parameter.low < parameter.neutral && parameter.neutral < parameter.high;
        if first && inside { parameter.neutral + 0.05 * parameter.typical } else { parameter.typical }
    }
}

/// The forms that a declared effect may have: the one that the file states, or those that show and have the parameters it knows.
fn possible_forms(declared: &DeclaredEffect, measured: impl Fn(&Form) -> bool) -> Vec<&'static Form> {
    let mut forms: Vec<_> = match declared.form {
        Some(form) => vec![form],
        None => declared.open_forms().filter(|form| measured(form)).collect(),
    };
    if forms.is_empty() {
        forms.extend(declared.first_form());
    }
    forms
}

/// Where the change of a reference only moves another parameter, it is held at the middle of what was measured.
fn reference(parameter: &str, measurements: &Measurements) -> Option<f64> {
    let middle = |value: fn(&kapvik_firmware::terramechanics::effects::Conditions<f64>) -> Option<f64>| {
        median(measurements.conditions.iter().filter_map(value).collect())
    };
    match parameter {
        "reference_load_n" => measurements.median(Reading::Load),
        "reference_speed_m_s" => median(measurements.speeds_m_s().flatten().collect()).filter(|speed| *speed > 0.0),
        "reference_c" => middle(|conditions| conditions.temperature_c),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// How many combinations of forms there are where everything is measured.
    fn combinations(declared: &str) -> Result<usize, usize> {
        let csv = "run,t_s,slip,load_n,torque_nm\na,0,0.1,65,1.2\n";
        let toml = format!(
            "name = \"a\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.075\nwidth_m = 0.07\n[declared]\n{declared}"
        );
        let campaign = Campaign::parse(Path::new("a.csv"), csv, &toml).expect("a campaign");
        Specification::declared(&campaign, |_| true).map(|found| found.len())
    }

    #[test]
    fn more_combinations_than_can_be_tried_are_counted() {
        assert_eq!(combinations("effects = [\"force-bias\"]\n"), Ok(3));
        let many = "effects = [\"force-bias\", \"force-drift\", \"crosstalk\", \"rate\", \"multi-pass\"]\n";
        assert!(combinations(many).is_err_and(|count| count > MOST_COMBINATIONS));
    }
}
