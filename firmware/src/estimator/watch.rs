//! Notices when measurements contradict a filter: for a frame they are wrong, for several the filter is.

use crate::filter::{Fate, Gate, Innovation};
use crate::scalar::Scalar;

/// Frames in a row with a rejected measurement after which the state is taken to have moved faster than it drifts.
const MOVED: u8 = 2;
/// Frames in a row after which the filter gives up what it believes.
const WRONG: u8 = 12;
/// Frames in which a filter that gave up does not give up again: else one bad sensor would keep it from ever learning.
const REST: u8 = 50;

/// What a filter is to make of its contradictions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Contradiction {
    /// None, or one that may be a bad measurement.
    Passing,
    /// The state has moved: loosen it.
    Moved,
    /// The filter is wrong: give up what it believes.
    Wrong,
}

/// The count of contradictions of one filter.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Watch {
    in_a_row: u8,
    rest: u8,
    relearned: u32,
}

impl Watch {
    /// Takes what an update told.
    pub fn judge<S, const M: usize>(&mut self, told: &Innovation<S, M>) -> Contradiction {
        self.rest = self.rest.saturating_sub(1);
        let rejected = told.residuals.iter().any(|residual| residual.fate == Fate::Rejected);
        self.in_a_row = if rejected { self.in_a_row.saturating_add(1) } else { 0 };
        if self.in_a_row >= WRONG && self.rest == 0 {
            (self.in_a_row, self.rest) = (0, REST);
            self.relearned = self.relearned.saturating_add(1);
            Contradiction::Wrong
        } else if self.in_a_row >= MOVED {
            Contradiction::Moved
        } else {
            Contradiction::Passing
        }
    }

    /// The gate of the next update. A filter that has just given up what it believed takes whatever plausible it is told: were its wide
    /// spread still too narrow, it would refuse good measurements for ever.
    pub fn gate<S: Scalar>(&self) -> Gate<S> {
        if self.rest == REST { Gate::Open } else { Gate::one_in_a_thousand() }
    }

    /// How often the filter gave up.
    pub fn relearned(&self) -> u32 {
        self.relearned
    }
}

#[cfg(test)]
mod tests {
    use super::{Contradiction, REST, WRONG, Watch};
    use crate::filter::{Fate, Gate, Innovation, Residual};

    /// A measurement that is refused time after time opens the gate for one update in twelve at first, then not again for fifty.
    #[test]
    fn what_is_refused_for_long_is_let_in_once() {
        let refused = Residual { fate: Fate::Rejected, innovation: 9.0, std: 0.5 };
        let told = Innovation { residuals: [refused], ..Innovation::<f64, 1>::nothing() };
        let mut watch = Watch::default();
        let opened: Vec<u8> = (1..=WRONG + REST)
            .filter(|_| {
                let wrong = watch.judge(&told) == Contradiction::Wrong;
                assert_eq!(wrong, watch.gate::<f64>() == Gate::Open);
                wrong
            })
            .collect();
        assert_eq!(opened, [WRONG, WRONG + REST]);
    }
}
