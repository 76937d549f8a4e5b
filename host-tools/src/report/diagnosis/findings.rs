//! What is shown of a diagnosis.

use std::collections::BTreeMap;

use crate::data::campaign::{Campaign, Channel, Knowledge, Provenance};
use crate::diagnose::document::Diagnosis;
use crate::diagnose::{Trace, Traced};

/// A diagnosis with what is drawn of it.
#[derive(Debug, Clone)]
pub struct DiagnosisFindings {
    /// What was found.
    pub diagnosis: Diagnosis,
    /// Where the numbers come from.
    pub provenance: Provenance,
    /// Citation and licence of the campaign.
    pub source: String,
    /// What was known of the soil by other means; keys as in `[soil]`.
    pub known: BTreeMap<&'static str, Knowledge>,
    /// The run of every row of the campaign.
    pub runs: Vec<String>,
    /// Every column of the campaign by its name, a number or nothing for each row; and any other that a residual was held against.
    pub columns: BTreeMap<String, Vec<Option<f64>>>,
    /// Measured channels, each with its predictions.
    pub traces: Vec<Trace>,
    /// The column that the residual of the declared model follows best; a product is written `slip*sinkage_m`.
    pub guilty: Option<String>,
}

/// The declared model, or that with the effects found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The declared model.
    Before,
    /// With the effects found.
    After,
}

impl Side {
    /// Both, from left to right.
    pub const BOTH: [Self; 2] = [Self::Before, Self::After];

    /// The one of two things that is this side's.
    pub fn of<T>(self, [before, after]: [T; 2]) -> T {
        match self {
            Self::Before => before,
            Self::After => after,
        }
    }

    /// The class of its shapes.
    pub fn class(self) -> &'static str {
        self.of(["before", "after"])
    }
}

impl Traced {
    /// What was predicted.
    pub fn predicted(&self, side: Side) -> Option<f64> {
        side.of([self.before, self.after])
    }

    /// Measured − predicted, in standard deviations of the noise.
    pub fn residual(&self, side: Side) -> Option<f64> {
        Some((self.measured - self.predicted(side)?) / self.noise)
    }
}

impl DiagnosisFindings {
    /// A diagnosis of a campaign; `traces` have an entry for each of its rows.
    pub fn new(campaign: &Campaign, diagnosis: Diagnosis, traces: Vec<Trace>, guilty: Option<String>) -> Self {
        let mut columns: BTreeMap<String, Vec<Option<f64>>> =
            campaign.columns().filter_map(|name| Some((name.to_owned(), campaign.column(name)?.to_vec()))).collect();
        let times = campaign.rows().iter().map(|row| Some(row.t_s)).collect();
        columns.insert(Channel::Time.name().to_owned(), times);
        Self {
            diagnosis,
            provenance: campaign.provenance,
            source: campaign.source.clone(),
            known: known(campaign),
            runs: campaign.rows().iter().map(|row| row.run.clone()).collect(),
            columns,
            traces,
            guilty,
        }
    }

    /// What every row has in a column, or in a product of columns; none where there is no such column.
    pub fn column(&self, name: &str) -> Option<Vec<Option<f64>>> {
        if let Some(values) = self.columns.get(name) {
            return Some(values.clone());
        }
        let mut factors = name.split('*').map(|factor| self.columns.get(factor.trim()));
        let first = factors.next()??.clone();
        factors.try_fold(first, |product, factor| {
            Some(product.iter().zip(factor?).map(|(one, other)| Some((*one)? * (*other)?)).collect())
        })
    }

    /// The declared model in a few words.
    pub fn before_in_words(&self) -> String {
        match self.diagnosis.declared.as_slice() {
            [] => "before: equations 1–11, refitted".to_owned(),
            declared => format!("before: equations 1–11 with {}, refitted", declared.join(", ")),
        }
    }

    /// The model after it in a few words.
    pub fn after_in_words(&self) -> String {
        let effects: Vec<&str> = self.diagnosis.effects.iter().map(|effect| effect.id.as_str()).collect();
        if effects.is_empty() {
            return "after: the same, nothing was added".to_owned();
        }
        format!("after: with {}", effects.join(" and "))
    }
}

/// What is known of the soil, by the keys of `[soil]`.
fn known(campaign: &Campaign) -> BTreeMap<&'static str, Knowledge> {
    let ground = &campaign.ground;
    let all = [
        ("n", ground.sinkage_exponent),
        ("k_c", ground.cohesive_modulus),
        ("k_phi", ground.frictional_modulus),
        ("k_eff", ground.stiffness(&campaign.wheel)),
        ("c", ground.cohesion_pa),
        ("phi", ground.friction_angle_rad),
        ("K", ground.shear_modulus_m),
        ("c1", ground.peak_stress_c1),
        ("c2", ground.peak_stress_c2),
        ("eta", ground.rebound_ratio),
    ];
    all.into_iter().filter_map(|(key, known)| Some((key, known?))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sample::findings;

    #[test]
    fn a_product_of_columns_is_a_column() {
        let findings = findings();
        let [slip, sinkage, both] = ["slip", "sinkage_m", "slip*sinkage_m"]
            .map(|name| findings.column(name).expect("a column")[4].expect("measured"));
        assert_eq!(both, slip * sinkage);
        assert_eq!(findings.column("slip*none"), None);
        assert_eq!(findings.column("t_s").map(|times| times.len()), Some(27));
    }
}
