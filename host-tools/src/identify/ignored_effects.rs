//! Effects that a campaign declares and that a method does not know: what ignoring them does to its answer, by `map`, which knows them.
//!
//! The soil that the same data show without the effects and with them differs by what an answer without them is off, for the effects' sizes
//! that are found; and where those are fitted, the soil is known less well with them, by as much as another size would move it.

use crate::digits::significant;
use crate::parameter::Parameter;

use super::method::{Finding, Statement};

/// What `map` says of a run with the effects that its campaign declares, and without them.
pub struct BothWays<'a> {
    /// With them.
    pub with: &'a Finding,
    /// Without.
    pub without: &'a Finding,
}

/// Why an answer that ignores the effects tells nothing: a number that it tells is moved by more than its standard deviation, or is not
/// told once they are known. None where no number is.
pub fn moved(found: &Finding, by_map: &BothWays<'_>, effects: &[String]) -> Option<String> {
    let BothWays { with, without } = by_map;
    let pairs = with.statements().into_iter().zip(without.statements());
    let moved = |(parameter, (told, (with, without))): (Parameter, (&Statement, (&Statement, &Statement)))| {
        let is_lost = without.identifiable && !with.identifiable;
        let shift = shift(with, without);
        (told.identifiable && (is_lost || shift > told.std)).then(|| {
            let [shift, std] = [shift, told.std].map(|number| significant(parameter.shown(number), 2));
            format!("{} by {shift} {} where it is told to {std}", parameter.symbol(), parameter.unit())
        })
    };
    let moved: Vec<String> =
        Parameter::ALL.into_iter().zip(found.statements().into_iter().zip(pairs)).filter_map(moved).collect();
    (!moved.is_empty()).then(|| {
        let effects = effects.join(", ");
        format!("declared and not known to the method: {effects}, by map worth {}", moved.join(" and "))
    })
}

/// Root mean square by which an answer without the effects is beside one with them: what they move, and what they leave open.
fn shift(with: &Statement, without: &Statement) -> f64 {
    let left_open = (with.std.powi(2) - without.std.powi(2)).max(0.0);
    (with.value - without.value).hypot(left_open.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::method::told_of_friction_angle as found;

    fn said(with: &Finding, without: &Finding) -> Option<String> {
        moved(&found(30.0, 1.0), &BothWays { with, without }, &["torque-scale".to_owned()])
    }

    #[test]
    fn what_effects_move_or_leave_open_is_not_told() {
        let without = found(30.0, 0.9);
        assert_eq!(said(&found(30.5, 1.2), &without), None, "0.5° and 0.8°");
        let moved = said(&found(33.0, 1.2), &without);
        let words = "declared and not known to the method: torque-scale, by map worth φ by 3.1 ° where it is told to 1";
        assert_eq!(moved.as_deref(), Some(words));
        assert!(said(&found(30.0, 2.0), &without).is_some(), "1.8° are left open");
        let mut lost = found(30.0, 0.9);
        lost.friction_angle_rad.identifiable = false;
        assert!(said(&lost, &without).is_some());
        assert_eq!(said(&lost, &lost), None, "not told without them either");
    }
}
