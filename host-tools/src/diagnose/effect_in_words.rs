//! What an effect does, as its parameters were found: one may be the opposite of what it is known for.

use std::collections::BTreeMap;

use kapvik_firmware::terramechanics::effects::{EffectInfo, Words};

use super::document::Estimate;

/// In a few words: by each parameter that says so, else in general.
pub fn effect_in_words(info: &EffectInfo, found: &BTreeMap<String, Estimate>) -> String {
    let mut said: Vec<&str> = Vec::new();
    for way in info.words.iter().filter_map(|words| way(info, words, found)) {
        if !said.contains(&way) {
            said.push(way);
        }
    }
    if said.is_empty() { info.summary.to_owned() } else { said.join(", and ") }
}

/// What a parameter makes of it; nothing where it was not found, or is neutral.
fn way(info: &EffectInfo, words: &Words, found: &BTreeMap<String, Estimate>) -> Option<&'static str> {
    let beyond = found.get(words.parameter)?.value - info.parameter(words.parameter)?.neutral;
    (beyond != 0.0).then_some(if beyond > 0.0 { words.above } else { words.below })
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::terramechanics::effects::{CATALOGUE, effect_info};

    use super::*;

    fn said(id: &str, parameters: &[(&str, f64)]) -> String {
        let estimate = |&(name, value): &(&str, f64)| (name.to_owned(), Estimate { value, std: 0.1 });
        effect_in_words(effect_info(id).expect("listed"), &parameters.iter().map(estimate).collect())
    }

    #[test]
    fn an_effect_is_told_as_it_was_found() {
        let cases = [
            ("slip-sinkage", &[("n1", 0.3)][..], "the wheel sinks deeper the more it slips"),
            ("slip-sinkage", &[("apparent", -0.2), ("saturation", 3.0)], "the wheel sinks less the more it slips"),
            // Less than a metre to a higher power is less: more of the exponent bears less.
            ("load-stiffening", &[("exponent", 0.8)], "the soil is softer under more load"),
            ("load-stiffening", &[("exponent", -0.1)], "the soil is stiffer under more load"),
            ("load-stiffening", &[("stiffness", -0.3)], "the soil is softer under more load"),
            (
                "multi-pass",
                &[("m1", 1.0), ("strength", -0.2)],
                "the soil is stiffer where a wheel has been, and the soil is weaker where a wheel has been",
            ),
            ("crosstalk", &[("load_to_drawbar_pull", -0.1)], "one force channel leaks into another"),
        ];
        for (id, parameters, expected) in cases {
            assert_eq!(said(id, parameters), expected, "{id} {parameters:?}");
        }
        assert_eq!(said("rate", &[]), effect_info("rate").expect("listed").summary);
    }

    #[test]
    fn words_are_of_parameters_that_there_are() {
        for info in CATALOGUE {
            assert!(info.words.iter().all(|words| info.parameter(words.parameter).is_some()), "{}", info.id);
        }
    }
}
