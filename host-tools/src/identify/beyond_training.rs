//! Soils that the networks have not learned: what they say of one is of the nearest soil that they know, and narrow.

use kapvik_firmware::soil::SoilEstimate;

use crate::digits::significant;
use crate::parameter::Parameter;
use crate::prior::Range;

use super::method::Finding;
use super::network::at_edge;

/// Why a run is of such a soil, by what `map` says of it, which knows no ends: an interval of 68 % that lies beyond what was learned.
pub fn beyond(found: &Finding) -> Option<String> {
    let told = |(parameter, statement): (Parameter, &super::method::Statement)| {
        let Range { low, high, .. } = parameter.prior();
        let [least, most] = statement.interval_68;
        (statement.identifiable && (least > high || most < low)).then(|| {
            let [value, std] = [statement.value, statement.std].map(|number| significant(parameter.shown(number), 2));
            let symbol = parameter.symbol();
            format!("by map {symbol} is {value} ± {std} {}, and they know {}", parameter.unit(), learned(parameter))
        })
    };
    let beyond: Vec<String> = Parameter::ALL.into_iter().zip(found.statements()).filter_map(told).collect();
    (!beyond.is_empty()).then(|| format!("the soil is beyond what the networks have learned: {}", beyond.join("; ")))
}

/// Why the soil of an estimate may be such a one: a number that is told lies at the end of what was learned.
pub fn at_an_end(estimate: &SoilEstimate) -> Option<String> {
    let is_at_end = |parameter: &Parameter| {
        let told = parameter.of(estimate);
        told.identifiable && at_edge(parameter.prior(), told.value.into())
    };
    let at_end: Vec<String> = Parameter::ALL
        .into_iter()
        .filter(is_at_end)
        .map(|parameter| format!("{} ({})", parameter.symbol(), learned(parameter)))
        .collect();
    (!at_end.is_empty()).then(|| {
        let at_end = at_end.join(" and ");
        format!("at the end of what the networks have learned, beyond which the soil may lie: {at_end}")
    })
}

/// The range that was learned, in words.
fn learned(parameter: Parameter) -> String {
    let Range { low, high, .. } = parameter.prior();
    let [low, high] = [low, high].map(|end| significant(parameter.shown(end), 2));
    format!("{low} to {high} {}", parameter.unit())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::method::Statement;

    fn found(friction_angle: Statement) -> Finding {
        let untold = Statement::normal(1.0, 1.0);
        Finding::of([untold, friction_angle, untold])
    }

    #[test]
    fn a_soil_beyond_what_was_learned_is_told_by_what_map_says() {
        let told = |degrees: f64| Statement { identifiable: true, ..Statement::normal(degrees.to_radians(), 0.01) };
        let said = beyond(&found(told(48.0))).expect("ten standard deviations beyond 42°");
        assert!(said.ends_with("by map φ is 48 ± 0.57 °, and they know 22 to 42 °"), "{said}");
        assert_eq!(beyond(&found(told(42.3))), None, "it may be 42°");
        assert_eq!(beyond(&found(Statement { identifiable: false, ..told(48.0) })), None);
    }
}
