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

/// The count of contradictions of one filter with `M` measurements.
#[derive(Debug, Clone, Copy)]
pub(super) struct Watch<const M: usize> {
    /// Of each measurement; one that is missing contradicts nothing and confirms nothing.
    in_a_row: [u8; M],
    /// Whether any of these is above zero.
    contradicted: bool,
    rest: u8,
    relearned: u32,
}

impl<const M: usize> Watch<M> {
    /// Nothing was contradicted yet.
    pub fn new() -> Self {
        Self { in_a_row: [0; M], contradicted: false, rest: 0, relearned: 0 }
    }

    /// Takes what an update told.
    pub fn judge<S>(&mut self, told: &Innovation<S, M>) -> Contradiction {
        self.rest = self.rest.saturating_sub(1);
        if !self.contradicted && told.residuals.iter().all(|residual| residual.fate != Fate::Rejected) {
            return Contradiction::Passing;
        }
        let (mut rejected, mut longest) = (false, 0);
        for (in_a_row, residual) in self.in_a_row.iter_mut().zip(&told.residuals) {
            match residual.fate {
                Fate::Rejected => {
                    *in_a_row = in_a_row.saturating_add(1);
                    rejected = true;
                    longest = longest.max(*in_a_row);
                }
                Fate::Used => *in_a_row = 0,
                Fate::Missing | Fate::NotFinite => {}
            }
        }
        self.contradicted = self.in_a_row.iter().any(|in_a_row| *in_a_row > 0);
        if !rejected {
            Contradiction::Passing
        } else if longest >= WRONG && self.rest == 0 {
            (self.in_a_row, self.rest) = ([0; M], REST);
            self.relearned = self.relearned.saturating_add(1);
            Contradiction::Wrong
        } else if longest >= MOVED {
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
        let mut watch = Watch::new();
        let opened: Vec<u8> = (1..=WRONG + REST)
            .filter(|_| {
                let wrong = watch.judge(&told) == Contradiction::Wrong;
                assert_eq!(wrong, watch.gate::<f64>() == Gate::Open);
                wrong
            })
            .collect();
        assert_eq!(opened, [WRONG, WRONG + REST]);
    }

    /// A sensor that speaks in one frame of five is heard as well.
    #[test]
    fn missing_measurements_confirm_nothing() {
        let of = |fate: Fate| Innovation {
            residuals: [Residual { fate, innovation: 9.0, std: 0.5 }],
            ..Innovation::<f64, 1>::nothing()
        };
        let mut watch = Watch::new();
        let mut judged = |fate: Fate| watch.judge(&of(fate));
        assert_eq!(judged(Fate::Rejected), Contradiction::Passing);
        (0..4).for_each(|_| assert_eq!(judged(Fate::Missing), Contradiction::Passing));
        assert_eq!(judged(Fate::Rejected), Contradiction::Moved);
        assert_eq!(judged(Fate::Used), Contradiction::Passing);
        assert_eq!(judged(Fate::Rejected), Contradiction::Passing);
    }
}
