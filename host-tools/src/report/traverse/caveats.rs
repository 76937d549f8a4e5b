//! What a reader must know before believing a number.

use kapvik_firmware::soil::SoilEstimate;

use super::findings::{Origin, TraverseFindings};
use crate::report::parameter::Parameter;

/// The caveats that hold for these findings, in plain sentences.
pub fn caveats(findings: &TraverseFindings) -> Vec<String> {
    let simulated = matches!(findings.origin, Origin::Simulated { .. }).then(|| {
        let trained = match &findings.flight.networks {
            None => "the same that the networks were trained with".to_owned(),
            Some(networks) => format!("while the networks were trained with effects ({})", networks.effects),
        };
        format!(
            "The drive is simulated: a rocker-bogie on uneven sand whose wheels obey equations 1–11, {trained}. Real sand \
             does more than these equations."
        )
    });
    let assumed = findings.rover_is_assumed().then(|| {
        "The rover's dimensions and the noise of its sensors are the set K0, which is assumed: Kapvik's were not published, \
         beside mass and envelope. With another rover the numbers are other numbers; give yours with --rover."
            .to_owned()
    });
    let split = "Of the drawbar pull of a bogie's two wheels, the sensors tell the sum alone; how it is split follows from \
                 the wheels' torques, and its uncertainty is in the bands.";
    [simulated, assumed, Some(split.to_owned()), cannot_be_told(findings), outside(findings)]
        .into_iter()
        .flatten()
        .collect()
}

fn last_soil(findings: &TraverseFindings) -> Option<&SoilEstimate> {
    findings.outcome.soil.as_ref().ok().map(|soil| &soil.estimate)
}

fn cannot_be_told(findings: &TraverseFindings) -> Option<String> {
    let soil = last_soil(findings)?;
    let untold = Parameter::ALL.into_iter().filter(|parameter| !parameter.of(soil).identifiable);
    let symbols: Vec<&str> = untold.map(Parameter::symbol).collect();
    (!symbols.is_empty()).then(|| {
        format!(
            "\u{201c}Cannot be told\u{201d} ({} at the end) means that the drive removed less than half of the variance that \
             there was before it: the value is then mostly the middle of what the training allowed.",
            symbols.join(", ")
        )
    })
}

fn outside(findings: &TraverseFindings) -> Option<String> {
    last_soil(findings)?.outside_training_range.then(|| {
        "At the end the wheels' states lie outside the range that the networks were trained on: the soil cannot be relied on."
            .to_owned()
    })
}
