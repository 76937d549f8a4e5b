//! The errors against the truth in the units that people read, for page and terminal.

use crate::report::draw::number;
use crate::trial::Quantity;
use crate::trial::errors::Errors;

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
    let (name, unit, factor, digits) = words(quantity);
    let tally = errors.of(quantity);
    let shown = |value: f64| {
        if value.is_finite() { format!("{}{unit}", number(factor * value, digits, false)) } else { "–".to_owned() }
    };
    let [one, two] = tally.coverage().map(|share| match quantity.states_std() {
        true => format!("{:.0} %", 100.0 * share),
        false => "–".to_owned(),
    });
    [name.to_owned(), shown(tally.rmse()), shown(tally.naive_rmse()), number(tally.over_naive(), 2, false), one, two]
}

/// Name, unit, factor from SI units, and digits.
fn words(quantity: Quantity) -> (&'static str, &'static str, f64, usize) {
    match quantity {
        Quantity::Slip => ("Slip", "", 1.0, 4),
        Quantity::Torque => ("Resistive torque", " N·m", 1.0, 3),
        Quantity::ContactAngle => ("Contact angle", "°", 1_f64.to_degrees(), 2),
        Quantity::Load => ("Normal load", " N", 1.0, 2),
        Quantity::FrontPull => ("Drawbar pull, front wheels", " N", 1.0, 2),
        Quantity::BogiePull => ("Drawbar pull, both wheels of a bogie", " N", 1.0, 2),
        Quantity::SplitPull => ("… of one of them, split by torque", " N", 1.0, 2),
        Quantity::LoadSplitPull => ("… split by load", " N", 1.0, 2),
    }
}
