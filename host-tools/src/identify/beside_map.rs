//! Answers that `map` denies, which takes no equation for simpler than it is and nothing for known.

use crate::digits::significant;
use crate::parameter::Parameter;

use super::method::{Finding, Statement};

/// Standard deviations of both together by which two methods do not say the same.
const APART: f64 = 3.0;

/// By which of its numbers an answer is not what `map` says, where both tell it; none where there is none.
pub fn beside(found: &Finding, by_map: &Finding) -> Option<String> {
    let denied = |(parameter, (one, other)): (Parameter, (&Statement, &Statement))| {
        let are_told = one.identifiable && other.identifiable;
        let is_apart = (one.value - other.value).abs() > APART * one.std.hypot(other.std);
        (are_told && is_apart).then(|| {
            let [value, std] = [other.value, other.std].map(|number| significant(parameter.shown(number), 3));
            format!("{} {value} ± {std} {}", parameter.symbol(), parameter.unit())
        })
    };
    let statements = found.statements().into_iter().zip(by_map.statements());
    let denied: Vec<String> = Parameter::ALL.into_iter().zip(statements).filter_map(denied).collect();
    (!denied.is_empty()).then(|| format!("by map it is another soil: {}", denied.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::method::told_of_friction_angle as found;

    #[test]
    fn what_both_tell_and_tell_apart_is_denied() {
        let by_map = found(28.7, 3.8);
        assert_eq!(beside(&found(9.6, 0.2), &by_map).as_deref(), Some("by map it is another soil: φ 28.7 ± 3.8 °"));
        assert_eq!(beside(&found(18.0, 0.2), &by_map), None, "2.8 standard deviations");
        assert_eq!(beside(&found(9.6, 6.0), &by_map), None, "wide enough itself");
        let mut untold = by_map;
        untold.friction_angle_rad.identifiable = false;
        assert_eq!(beside(&found(9.6, 0.2), &untold), None);
    }
}
