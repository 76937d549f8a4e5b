//! Whether rows have their place in common: all early in their runs, or at one end of a column that tells no force, sinkage or slip.
//!
//! Gross errors fall anywhere. Where rows that a model leaves far out lie together, they bear each other out.

use kapvik_firmware::terramechanics::effects::Conditions;

use super::measurements::Measurements;
use crate::statistics::ends;

/// Fewer rows lie together by chance.
const LEAST_ROWS: usize = 4;
/// Share of all rows that may lie as far out in a column as these do: of sets of four rows anywhere less than two in a hundred then lie
/// together in any of the columns.
const END: f64 = 0.2;

type Column = fn(&Conditions<f64>) -> Option<f64>;

/// What a row's place is told by.
const COLUMNS: [Column; 4] = [|row| row.pass, |row| row.temperature_c, |row| row.hours_since_zero, |row| row.travel_m];

/// Whether rows lie together.
pub fn share_a_place(measurements: &Measurements, rows: &[usize]) -> bool {
    if rows.len() < LEAST_ROWS {
        return false;
    }
    let columns = COLUMNS.map(|column| measurements.conditions.iter().map(column).collect::<Vec<_>>());
    columns.iter().any(|column| lie_at_an_end(column, rows)) || lie_at_an_end(&order_in_run(measurements), rows)
}

/// How many rows of its run are before each row.
fn order_in_run(measurements: &Measurements) -> Vec<Option<f64>> {
    let mut order = vec![None; measurements.rows.len()];
    for run in &measurements.rows_of_run {
        for (place, row) in run.iter().enumerate() {
            order[*row] = Some(place as f64);
        }
    }
    order
}

/// Whether rows are among the few with the lowest values of a column, or the highest.
fn lie_at_an_end(column: &[Option<f64>], rows: &[usize]) -> bool {
    let Some(own) = rows.iter().map(|row| column[*row]).collect::<Option<Vec<f64>>>() else { return false };
    let Some((low, high)) = ends(own) else { return false };
    let are_few = |is_as_far: &dyn Fn(f64) -> bool| {
        column.iter().flatten().filter(|value| is_as_far(**value)).count() as f64 <= END * column.len() as f64
    };
    are_few(&|value| value <= high) || are_few(&|value| value >= low)
}

#[cfg(test)]
mod tests {
    use super::lie_at_an_end;

    #[test]
    fn the_first_rows_of_runs_lie_together_and_scattered_ones_do_not() {
        let order: Vec<Option<f64>> = (0..60).map(|row| Some(f64::from(row % 10))).collect();
        assert!(lie_at_an_end(&order, &[0, 10, 20, 30, 41]));
        assert!(lie_at_an_end(&order, &[9, 19, 29, 58]));
        assert!(!lie_at_an_end(&order, &[0, 10, 20, 35]));
    }

    #[test]
    fn a_column_that_says_nothing_or_is_missing_puts_nothing_together() {
        let mut column = vec![Some(1.0); 60];
        assert!(!lie_at_an_end(&column, &[0, 1, 2, 3]));
        column = (0..60).map(|row| Some(f64::from(row))).collect();
        assert!(lie_at_an_end(&column, &[0, 1, 2, 3]));
        column[2] = None;
        assert!(!lie_at_an_end(&column, &[0, 1, 2, 3]));
    }
}
