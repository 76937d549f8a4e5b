//! What a reader must know before believing a number.

use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};

use super::findings::{Origin, TraverseFindings};
use crate::data::assumed_keys::AssumedKeys;
use crate::parameter::Parameter;

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
    let assumed = (!findings.assumed.are_none()).then(|| assumed_in_words(&findings.assumed));
    let no_truth = findings.truth_is_of_other_times.then(|| {
        "The truth beside the frames has no row at the time of any of them: nothing is compared with it.".to_owned()
    });
    let split = "Of the drawbar pull of a bogie's two wheels, the sensors tell the sum alone; how it is split follows from \
                 the wheels' torques, and its uncertainty is in the bands.";
    [
        simulated,
        assumed,
        no_truth,
        Some(split.to_owned()),
        cannot_be_told(findings),
        at_the_end(findings),
        outside(findings),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Said where there is something assumed.
fn assumed_in_words(assumed: &AssumedKeys) -> String {
    match assumed.are_all() {
        true => {
            "The rover's dimensions and the noise of its sensors are the set K0, which is assumed: of Kapvik only mass \
                 and envelope were published. For another rover the results differ; give yours with --rover."
                .to_owned()
        }
        false => format!(
            "The rover file leaves out {assumed}: this is assumed (set K0): of Kapvik only mass and envelope were published. For another \
             rover the results differ."
        ),
    }
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

fn at_the_end(findings: &TraverseFindings) -> Option<String> {
    let soil = last_soil(findings)?;
    let reaching = Parameter::ALL.into_iter().filter_map(|parameter| {
        let end = end_of_training(parameter, parameter.of(soil))?;
        Some(format!("{} at {} {}", parameter.symbol(), parameter.number(end), parameter.unit()))
    });
    let reaching: Vec<String> = reaching.collect();
    (!reaching.is_empty()).then(|| {
        format!(
            "Intervals end where the training did ({}): the networks know no soil beyond it, and take one that is \
             (ice-cemented, for example) for one near that end.",
            reaching.join(", ")
        )
    })
}

/// The end of what the networks were trained for, if a parameter is told and its interval reaches that end.
fn end_of_training(parameter: Parameter, estimate: &ParameterEstimate) -> Option<f64> {
    const REACHES: f64 = 1.0e-3;
    let trained = parameter.prior();
    let [least, greatest] = estimate.interval_95.map(|end| trained.share(f64::from(end)));
    let end = if greatest > 1.0 - REACHES {
        trained.high
    } else if least < REACHES {
        trained.low
    } else {
        return None;
    };
    estimate.identifiable.then_some(end)
}

fn outside(findings: &TraverseFindings) -> Option<String> {
    last_soil(findings)?.outside_training_range.then(|| {
        "At the end the wheels' states lie outside the range that the networks were trained on: the soil cannot be relied on."
            .to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(interval_95: [f32; 2]) -> ParameterEstimate {
        let value = (interval_95[0] + interval_95[1]) / 2.0;
        ParameterEstimate { value, std: 0.02, interval_68: interval_95, interval_95, identifiable: true }
    }

    #[test]
    fn an_interval_that_reaches_the_end_of_the_training_is_named() {
        let trained = Parameter::FrictionAngle.prior();
        let (low, high) = (trained.low as f32, trained.high as f32);
        let end = |estimate: &ParameterEstimate| end_of_training(Parameter::FrictionAngle, estimate);
        assert_eq!(end(&told([0.5, 0.6])), None);
        assert_eq!(end(&told([0.68, high])), Some(trained.high));
        assert_eq!(end(&told([low, 0.45])), Some(trained.low));
        assert_eq!(end(&ParameterEstimate { identifiable: false, ..told([0.6, high]) }), None);
    }
}
