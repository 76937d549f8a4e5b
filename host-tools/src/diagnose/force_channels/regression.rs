//! A force channel as a sum of terms.

use crate::data::campaign::Channel;

/// A channel and what it may follow, row by row.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The channel.
    pub channel: Channel,
    /// Its readings, N.
    pub readings_n: Vec<f64>,
    /// The run of each row, counted from 0 without gaps.
    pub run: Vec<usize>,
    /// Columns that are always in: an intercept for each level.
    pub fixed: Vec<Vec<f64>>,
    /// What moves the forces without being one: powers of slip. Terms that are forces are seen through these alone.
    pub instruments: Vec<Vec<f64>>,
    /// What may be added.
    pub terms: Vec<Term>,
}

/// One thing that a channel may follow.
#[derive(Debug, Clone)]
pub struct Term {
    /// The effect.
    pub id: &'static str,
    /// Its form.
    pub form: &'static str,
    /// The parameter that the form frees.
    pub parameter: &'static str,
    /// What the effect adds to the reading for a parameter of one, row by row.
    pub values: Vec<f64>,
    /// Whether the term is a force that a change of the true load moves as well. A regression on its reading would take the
    /// scatter of the true load for an effect of the force.
    pub by_instruments: bool,
}

impl Term {
    /// The effect and its form, in words.
    pub fn words(&self) -> String {
        format!("{} ({})", self.id, self.form)
    }
}

impl Problem {
    /// Rows.
    pub fn rows(&self) -> usize {
        self.readings_n.len()
    }

    /// Runs.
    pub fn runs(&self) -> usize {
        self.run.iter().max().map_or(0, |last| last + 1)
    }
}

/// Numbers a row's run from 0 without gaps, in the order of first appearance.
pub fn without_gaps(runs: &[usize]) -> Vec<usize> {
    let mut seen: Vec<usize> = Vec::new();
    let number = |run: &usize| {
        seen.iter().position(|other| other == run).unwrap_or_else(|| {
            seen.push(*run);
            seen.len() - 1
        })
    };
    runs.iter().map(number).collect()
}
