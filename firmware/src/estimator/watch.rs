//! Notices when measurements contradict a filter for long: then the filter is wrong, not they.

use crate::filter::{Fate, Innovation};

/// Frames in a row with a rejected measurement after which the filter gives up what it believes.
const PATIENCE: u8 = 8;
/// Frames in which a filter that gave up does not give up again: else one bad sensor would keep it from ever learning.
const REST: u8 = 50;

/// The count of contradictions of one filter.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Watch {
    in_a_row: u8,
    rest: u8,
    relearned: u32,
}

impl Watch {
    /// Takes what an update told. Whether the filter must now give up what it believes.
    pub fn contradicted<S, const M: usize>(&mut self, told: &Innovation<S, M>) -> bool {
        self.rest = self.rest.saturating_sub(1);
        let rejected = told.residuals.iter().any(|residual| residual.fate == Fate::Rejected);
        self.in_a_row = if rejected { self.in_a_row.saturating_add(1) } else { 0 };
        let gives_up = self.in_a_row >= PATIENCE && self.rest == 0;
        if gives_up {
            (self.in_a_row, self.rest) = (0, REST);
            self.relearned = self.relearned.saturating_add(1);
        }
        gives_up
    }

    /// How often the filter gave up.
    pub fn relearned(&self) -> u32 {
        self.relearned
    }
}
