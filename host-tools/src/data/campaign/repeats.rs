//! Rows in which a logger wrote once more what its sensors had said before: it writes faster than they speak.

use super::{Channel, Measured, RowId};

/// What the sensors of a wheel read. Clocks and ways go on while these say nothing new.
const SENSED: [Channel; 6] =
    [Channel::Slip, Channel::Load, Channel::DrawbarPull, Channel::Torque, Channel::Sinkage, Channel::SideForce];
/// Fewest channels that vary in a campaign and that have to agree: one or two numbers of few digits do so by chance.
const FEWEST: usize = 3;
/// Share of the rows from which repeats are a logger's habit. Fewer are chance, or cost nothing.
const HABIT: f64 = 0.1;

/// Takes rows out that say in every such channel what the same wheel said an instant before, where a campaign has many, and tells how many
/// they were. The row before is another wheel where it has the same time, and two wheels may well say the same.
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

/// Of each row whether it says the same as an earlier one.
fn repeats(rows: &[RowId], columns: &[Measured]) -> Vec<bool> {
    let varying = varying(columns);
    let says_same = |row: usize, earlier: usize| {
        let same = |column: &&Measured| column.values[earlier] == column.values[row];
        let said = varying.iter().filter(|column| column.values[row].is_some()).count();
        said >= FEWEST && rows[earlier].run == rows[row].run && varying.iter().all(same)
    };
    let instant_before = an_instant_before(rows);
    let is_repeat = |row: usize| instant_before[row].is_some_and(|earlier| says_same(row, earlier));
    (0..rows.len()).map(is_repeat).collect()
}

/// What the sensors of a wheel read that is not one number throughout.
pub(super) fn varying(columns: &[Measured]) -> Vec<&Measured> {
    let is_sensed = |column: &&Measured| SENSED.iter().any(|channel| channel.name() == column.name);
    let varies = |column: &&Measured| column.values.windows(2).any(|pair| pair[0] != pair[1]);
    columns.iter().filter(is_sensed).filter(varies).collect()
}

/// Of each row the one in its place among the rows of the instant before it; none where that has fewer.
fn an_instant_before(rows: &[RowId]) -> Vec<Option<usize>> {
    let mut before: Vec<Option<usize>> = Vec::with_capacity(rows.len());
    let mut last = 0..0;
    for instant in rows.chunk_by(|one, other| one.run == other.run && one.t_s == other.t_s) {
        before.extend((0..instant.len()).map(|place| Some(last.start + place).filter(|row| last.contains(row))));
        last = before.len() - instant.len()..before.len();
    }
    before
}
