//! Rows in which a logger wrote once more what its sensors had said before: it writes faster than they speak.

use super::{Channel, Measured, RowId};

/// What the sensors of a wheel read. Clocks and ways go on while these say nothing new.
const SENSED: [Channel; 6] =
    [Channel::Slip, Channel::Load, Channel::DrawbarPull, Channel::Torque, Channel::Sinkage, Channel::SideForce];
/// Fewest channels that have to vary in a campaign for a row that is like another to be one: two or three numbers with few
/// digits agree by chance.
const FEWEST: usize = 3;
/// Share of the rows from which repeats are a logger's habit. Fewer are chance, or cost nothing.
const HABIT: f64 = 0.1;

/// Takes rows out that say in every such channel what the row before them in the same run says, where a campaign has many, and
/// tells how many they were.
pub(super) fn take_out(rows: &mut Vec<RowId>, columns: &mut [Measured]) -> usize {
    let repeats = repeats(rows, columns);
    let count = repeats.iter().filter(|repeat| **repeat).count();
    if (count as f64) < HABIT * rows.len() as f64 {
        return 0;
    }
    keep(rows, &repeats);
    columns.iter_mut().for_each(|column| keep(&mut column.values, &repeats));
    count
}

fn keep<T>(all: &mut Vec<T>, repeats: &[bool]) {
    let mut repeats = repeats.iter();
    all.retain(|_| !repeats.next().is_some_and(|repeat| *repeat));
}

/// Of each row whether it says the same as the one before.
fn repeats(rows: &[RowId], columns: &[Measured]) -> Vec<bool> {
    let is_sensed = |column: &&Measured| SENSED.iter().any(|channel| channel.name() == column.name);
    let varies = |column: &&Measured| column.values.windows(2).any(|pair| pair[0] != pair[1]);
    let varying: Vec<&Measured> = columns.iter().filter(is_sensed).filter(varies).collect();
    let is_repeat = |row: usize| {
        let same = |column: &&Measured| column.values[row - 1] == column.values[row];
        let said = varying.iter().filter(|column| column.values[row].is_some()).count();
        said >= FEWEST && rows[row - 1].run == rows[row].run && varying.iter().all(same)
    };
    (0..rows.len()).map(|row| row > 0 && is_repeat(row)).collect()
}
