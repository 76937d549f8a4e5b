//! The errors against the truth in the units that people read, for page and terminal.

use crate::report::draw::number;
use crate::report::sentence::capitalised;
use crate::trial::Quantity;
use crate::trial::errors::Errors;
use crate::wheel_quantity::WheelQuantity;

/// The head of the table.
pub const HEAD: [&str; 6] = ["", "error, RMS", "raw sensors", "ratio", "within 1 σ", "within 2 σ"];

/// A line of the table.
pub fn rows(errors: &Errors) -> Vec<[String; 6]> {
    Quantity::ALL
        .into_iter()
        .filter(|quantity| errors.of(*quantity).count() > 0)
        .map(|quantity| row(quantity, errors))
        .collect()
}

fn row(quantity: Quantity, errors: &Errors) -> [String; 6] {
    let (kind, digits) = (quantity.kind(), digits(quantity.kind()));
    let unit = kind.spaced_unit();
    let tally = errors.of(quantity);
    let shown = |value: f64| {
        if value.is_finite() { format!("{}{unit}", number(kind.shown(value), digits, false)) } else { "–".to_owned() }
    };
    let [one, two] = tally.coverage().map(|share| match quantity.states_std() {
        true => format!("{:.0} %", 100.0 * share),
        false => "–".to_owned(),
    });
    [
        capitalised(quantity.name()),
        shown(tally.rmse()),
        shown(tally.naive_rmse()),
        number(tally.over_naive(), 2, false),
        one,
        two,
    ]
}

/// Digits behind the point.
fn digits(kind: WheelQuantity) -> usize {
    match kind {
        WheelQuantity::Slip => 4,
        WheelQuantity::ResistiveTorque => 3,
        WheelQuantity::ContactAngle | WheelQuantity::NormalLoad | WheelQuantity::DrawbarPull => 2,
    }
}
