//! Runs that hold the numbers of another once more, under a name of their own: two tables that were put together and share a part.

use std::collections::HashMap;

use super::{Campaign, repeats};

/// Fewest numbers in which two runs have to agree: those of a few averaged windows, in few digits, do so by chance.
const FEWEST: usize = 12;

impl Campaign {
    /// Of each row whether its run, as the file has it, says in every channel of the wheel's sensors, row by row, what an earlier run says.
    /// Such a run is no independent one.
    pub fn copies(&self) -> &[bool] {
        &self.copies
    }

    pub(super) fn find_copies(&self) -> Vec<bool> {
        let varying = repeats::varying(&self.columns);
        let mut firsts = HashMap::new();
        let mut copies = vec![false; self.rows.len()];
        for (run, (_, places)) in self.runs().into_iter().enumerate() {
            let said: Vec<Option<u64>> = places
                .iter()
                .flat_map(|place| varying.iter().map(|column| column.values[*place].map(f64::to_bits)))
                .collect();
            if said.iter().flatten().count() >= FEWEST && *firsts.entry(said).or_insert(run) != run {
                places.iter().for_each(|place| copies[*place] = true);
            }
        }
        copies
    }
}
