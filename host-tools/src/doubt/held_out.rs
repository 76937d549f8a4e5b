//! How honest standard deviations are before and after, on rows that took no part in training. Errors of sides that start or stop count here
//! as they do in training: one and a half times.

use comfy_table::Table;
use kapvik_firmware::estimator::doubt::{DoubtMemory, DoubtNetwork, OUTPUTS, QUANTITIES, times_stated};

use super::drives::{Driven, NOMINAL};
use super::loss::loss;
use super::rows::{Known, OF_WHEEL, Row, SideRows};
use crate::simulate::Scenario;
use crate::terminal_table::{align_right, plain_table};
use crate::wheel_quantity::WheelQuantity;

/// What is stated: of each wheel, and of each bogie its pull.
const STATED: usize = QUANTITIES + 1;

/// Errors within one and within two standard deviations, and the loss.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tally {
    rows: u64,
    loss: f64,
    within: [[u64; STATED]; 2],
}

/// The same rows as the filters state them and with the network.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BeforeAfter {
    /// With the standard deviations that the filters state.
    pub before: Tally,
    /// With those that the network makes of them.
    pub after: Tally,
}

impl Tally {
    /// Of what is known of some sides; `outputs` are those of each row of a side in turn.
    pub fn of(sides: &[SideRows], outputs: impl Fn(&[Row]) -> Vec<[f32; OUTPUTS]>) -> Self {
        let mut tally = Self::default();
        for side in sides {
            for (row, outputs) in side.iter().zip(outputs(side)) {
                if let Some(known) = &row.known {
                    tally.add_row(known, &outputs);
                }
            }
        }
        tally
    }

    fn add_row(&mut self, known: &Known, outputs: &[f32; OUTPUTS]) {
        self.rows += 1;
        self.loss += f64::from(loss(outputs, known).value);
        for (place, (error, output)) in known.errors.iter().zip(outputs).enumerate() {
            let stated = if place + 1 < OUTPUTS { place % QUANTITIES } else { QUANTITIES };
            let times = times_stated(*output);
            for (within, stds) in self.within.iter_mut().zip([1.0, 2.0]) {
                within[stated] += u64::from(error.abs() <= stds * times);
            }
        }
    }

    /// The loss a row.
    pub fn mean_loss(&self) -> f64 {
        self.loss / self.rows.max(1) as f64
    }

    /// Shares of the errors in what is stated that lie within one and within two standard deviations.
    fn shares(&self, stated: usize) -> [f64; 2] {
        let errors = self.rows.max(1) * if stated < QUANTITIES { 3 } else { 1 };
        self.within.map(|within| within[stated] as f64 / errors as f64)
    }

    /// Their means over all that is stated.
    pub fn mean_shares(&self) -> [f64; 2] {
        let sum = (0..STATED).map(|stated| self.shares(stated));
        sum.fold([0.0; 2], |[one, two], [first, second]| [one + first, two + second]).map(|sum| sum / STATED as f64)
    }

    fn add(&mut self, other: &Self) {
        self.rows += other.rows;
        self.loss += other.loss;
        let pairs = self.within.as_flattened_mut().iter_mut().zip(other.within.as_flattened());
        pairs.for_each(|(sum, part)| *sum += part);
    }
}

impl BeforeAfter {
    /// With and without the network.
    pub fn of(sides: &[SideRows], network: &DoubtNetwork) -> Self {
        Self { before: Tally::of(sides, believed), after: Tally::of(sides, |rows| flown(network, rows)) }
    }

    /// Of several sets together.
    pub fn total(sets: &[Self]) -> Self {
        let mut total = Self::default();
        for set in sets {
            total.before.add(&set.before);
            total.after.add(&set.after);
        }
        total
    }
}

/// The outputs of a network that believes the filters.
pub fn believed(rows: &[Row]) -> Vec<[f32; OUTPUTS]> {
    vec![[0.0; OUTPUTS]; rows.len()]
}

/// The outputs of a network for the rows of a side, as it flies.
pub fn flown(network: &DoubtNetwork, rows: &[Row]) -> Vec<[f32; OUTPUTS]> {
    let mut memory = DoubtMemory::EMPTY;
    rows.iter().map(|row| network.run(&mut memory, &row.inputs)).collect()
}

/// Both tables: scenario by scenario, and all of them together, quantity by quantity.
pub fn tables(driven: &[Driven; NOMINAL.len()], sets: &[BeforeAfter; NOMINAL.len()]) -> String {
    let mut scenarios = headed(&["scenario", "drives", "rows"], &["loss", "after"]);
    let names = NOMINAL.iter().map(Scenario::to_string);
    for ((name, driven), set) in names.zip(driven).zip(sets) {
        scenarios.add_row(of_scenario(name, driven.drives, set));
    }
    let total = BeforeAfter::total(sets);
    scenarios.add_row(of_scenario("all".to_owned(), driven.iter().map(|driven| driven.drives).sum(), &total));
    let mut quantities = headed(&["quantity"], &[]);
    for (stated, name) in OF_WHEEL.map(WheelQuantity::name).into_iter().chain(["bogie's pull"]).enumerate() {
        let shares = percentages(total.before.shares(stated), total.after.shares(stated));
        quantities.add_row(std::iter::once(name.to_owned()).chain(shares));
    }
    align_right(&mut scenarios);
    align_right(&mut quantities);
    format!("{scenarios}\n\n{quantities}\n\nof normal errors 68.3 % and 95.4 % would be within")
}

fn of_scenario(name: String, drives: usize, set: &BeforeAfter) -> Vec<String> {
    let BeforeAfter { before, after } = set;
    let mut cells = vec![name, drives.to_string(), before.rows.to_string()];
    cells.extend(percentages(before.mean_shares(), after.mean_shares()));
    cells.extend([before, after].map(|tally| format!("{:.3}", tally.mean_loss())));
    cells
}

fn percentages([one, two]: [f64; 2], [one_after, two_after]: [f64; 2]) -> [String; 4] {
    [one, one_after, two, two_after].map(|share| format!("{:.1}", 100.0 * share))
}

fn headed(first: &[&str], last: &[&str]) -> Table {
    let mut table = plain_table();
    let shares = ["within 1σ/%", "after", "within 2σ/%", "after"];
    table.set_header(first.iter().chain(&shares).chain(last).copied());
    table
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::estimator::doubt::INPUTS;

    use super::*;
    use crate::doubt::rows::tests::correlated;

    #[test]
    fn shares_are_of_each_quantity() {
        let mut known = Known { errors: [0.5; OUTPUTS], wheels: correlated() };
        known.errors[1] = 1.5;
        known.errors[OUTPUTS - 1] = -3.0;
        let row = Row { known: Some(known), ..Row::new(&[0.0; INPUTS]) };
        let sides = [vec![Row { known: None, ..row }, row]];
        let tally = Tally::of(&sides, believed);
        assert_eq!(tally.rows, 1, "of the other nothing is known");
        assert_eq!(tally.shares(0), [1.0, 1.0]);
        assert_eq!(tally.shares(1), [2.0 / 3.0, 1.0]);
        assert_eq!(tally.shares(QUANTITIES), [0.0, 0.0]);
        let doubled = Tally::of(&sides, |rows| vec![[1.0; OUTPUTS]; rows.len()]);
        assert_eq!(doubled.shares(QUANTITIES), [0.0, 1.0]);
        assert!((doubled.mean_shares()[0] - 5.0 / 6.0).abs() < 1e-12);
    }
}
