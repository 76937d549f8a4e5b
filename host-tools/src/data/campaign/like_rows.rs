//! Rows that repeat each other: by what these differ, sensors scatter.

/// A row by its place in the campaign, and the state of its wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipAndLoad {
    /// Its place.
    pub place: usize,
    /// Slip.
    pub slip: f64,
    /// Load, N; 0 where none is measured.
    pub load_n: f64,
}

/// Slips of like rows differ by no more.
const LIKE_SLIP: f64 = 0.01;

/// How often a row counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pairing {
    /// Each row is in one pair at most.
    Apart,
    /// Each may be the earlier of one pair and the later of another: of few rows more pairs.
    Chained,
}

/// Pairs of rows that are alike in slip, and in load to a share of it, by their places. Of several mates the one of the nearest slip is taken,
/// whatever its load: the nearest load would make that seem better known than it is. Rows of one slip stay in the order in which they come.
pub fn like_pairs(
    mut states: Vec<SlipAndLoad>,
    like_load: f64,
    pairing: Pairing,
    may_be_mates: impl Fn(usize, usize) -> bool,
) -> Vec<[usize; 2]> {
    states.sort_by(|a, b| a.slip.total_cmp(&b.slip));
    let mut pairs = Vec::new();
    let mut single: Vec<SlipAndLoad> = Vec::new();
    for state in states {
        single.retain(|earlier| state.slip - earlier.slip <= LIKE_SLIP);
        let is_mate = |earlier: &SlipAndLoad| {
            let is_like = (state.load_n - earlier.load_n).abs() <= like_load * earlier.load_n.abs();
            is_like && may_be_mates(earlier.place, state.place)
        };
        let mate = single.iter().rposition(is_mate).map(|place| single.remove(place));
        pairs.extend(mate.map(|mate| [mate.place, state.place]));
        if mate.is_none() || pairing == Pairing::Chained {
            single.push(state);
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three slips at two loads, swept twice: no row is beside its like by slip alone.
    #[test]
    fn a_grid_that_is_swept_twice_repeats_each_of_its_states() {
        let at = |place: usize| SlipAndLoad {
            place,
            slip: 0.1 * (place / 2 % 3) as f64,
            load_n: if place.is_multiple_of(2) { 40.0 } else { 80.0 },
        };
        let states: Vec<_> = (0..12).map(at).collect();
        let mut pairs = like_pairs(states.clone(), 0.05, Pairing::Apart, |_, _| true);
        pairs.sort_unstable();
        assert_eq!(pairs, [0, 1, 2, 3, 4, 5].map(|place| [place, place + 6]));
        assert!(like_pairs(states, 0.05, Pairing::Apart, |one, other| one / 6 == other / 6).is_empty());
    }

    #[test]
    fn of_three_like_rows_two_pairs_are_made_in_a_chain_and_one_apart() {
        let states: Vec<_> = (0..3).map(|place| SlipAndLoad { place, slip: 0.2, load_n: 50.0 }).collect();
        let pairs = |pairing| like_pairs(states.clone(), 0.05, pairing, |_, _| true);
        assert_eq!((pairs(Pairing::Chained), pairs(Pairing::Apart)), (vec![[0, 1], [1, 2]], vec![[0, 1]]));
    }
}
