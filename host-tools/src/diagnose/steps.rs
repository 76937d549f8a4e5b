//! Steps of the selection, each model's done once.

use std::cell::RefCell;

use super::bench::Bench;
use super::selection::{Step, step};
use super::trial::Trial;

/// Difference in ln posterior below which two fits of a model are the same optimum.
const SAME: f64 = 0.1;

/// The steps that were taken on a campaign. Ways to a pair of effects cross: each would ask again what an effect lacks.
pub struct Steps<'b, 'a> {
    /// The campaign.
    pub bench: &'b Bench<'a>,
    taken: RefCell<Vec<Step<'a>>>,
}

impl<'b, 'a> Steps<'b, 'a> {
    /// None taken yet.
    pub fn new(bench: &'b Bench<'a>) -> Self {
        Self { bench, taken: RefCell::default() }
    }

    /// The step on top of a model: one that was taken from a fit as good, or a new one.
    pub fn on(&self, base: &Trial<'a>) -> Step<'a> {
        let serves = |known: &&Step<'a>| {
            known.base.specification.names() == base.specification.names()
                && known.base.log_posterior() > base.log_posterior() - SAME
        };
        let known = self.taken.borrow().iter().find(serves).cloned();
        known.unwrap_or_else(|| {
            let new = step(self.bench, base);
            self.taken.borrow_mut().push(new.clone());
            new
        })
    }
}
