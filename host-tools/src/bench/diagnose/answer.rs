//! What a diagnosis said, as far as it is scored, and whether that was right.

use serde::Deserialize;

use super::campaign_draw::{Subject, Truth};
use crate::data::campaign::Channel;
use crate::diagnose::document::{Diagnosis, Unexplained, Verdict};

/// Most effects that a diagnosis may leave open between and still be right.
const OPEN_BETWEEN: usize = 3;

/// The part of a diagnosis that is scored; reads from what `diagnose` prints as well.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// The effects that earned their place, in order.
    pub effects: Vec<Named>,
    /// What cannot be told from the first.
    pub ambiguous_with: Vec<String>,
    /// Structure that is left, the most important first.
    pub unexplained: Vec<Structure>,
}

/// An effect by its id.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Named {
    /// The id.
    pub id: String,
}

/// Structure in a residual.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Structure {
    /// The channel that has it.
    pub channel: String,
    /// The column that it follows, or a product of columns with `*` between them.
    pub regressor: String,
}

impl From<&Diagnosis> for Answer {
    fn from(diagnosis: &Diagnosis) -> Self {
        let structure =
            |found: &Unexplained| Structure { channel: found.channel.clone(), regressor: found.regressor.clone() };
        Self {
            verdict: diagnosis.verdict,
            effects: diagnosis.effects.iter().map(|effect| Named { id: effect.id.clone() }).collect(),
            ambiguous_with: diagnosis.ambiguous_with.clone(),
            unexplained: diagnosis.unexplained.iter().map(structure).collect(),
        }
    }
}

impl Answer {
    /// The first effect.
    pub fn first(&self) -> Option<&str> {
        self.effects.first().map(|effect| effect.id.as_str())
    }

    /// The effects between which it is left open what is missing, few enough to be an answer; with the first.
    fn open(&self) -> impl Iterator<Item = &str> {
        let ids: Vec<&str> = self.first().into_iter().chain(self.ambiguous_with.iter().map(String::as_str)).collect();
        let distinct: Vec<&str> =
            ids.iter().enumerate().filter(|(place, id)| !ids[..*place].contains(id)).map(|(_, id)| *id).collect();
        if distinct.len() <= OPEN_BETWEEN { distinct } else { Vec::new() }.into_iter()
    }

    /// Whether the first effect is this one, or it is left open between at most three of which it is one.
    pub fn finds(&self, id: &str) -> bool {
        self.names() && (self.first_alone(id) || self.open().any(|open| open == id))
    }

    /// Whether the first effect is this one, and not left open.
    pub fn first_alone(&self, id: &str) -> bool {
        self.names() && self.ambiguous_with.is_empty() && self.first() == Some(id)
    }

    /// Whether this effect is among all that were found, or left open in place of the first.
    fn has(&self, id: &str) -> bool {
        self.names() && (self.finds(id) || self.effects.iter().any(|effect| effect.id == id))
    }

    fn names(&self) -> bool {
        matches!(self.verdict, Verdict::Effect | Verdict::Ambiguous)
    }

    /// Whether something is said to be missing.
    pub fn alarms(&self) -> bool {
        self.verdict != Verdict::None
    }

    /// Whether it says honestly that it sees structure in this channel that it cannot name.
    pub fn sees_in(&self, channel: Channel) -> bool {
        let first = self.unexplained.first().filter(|_| self.verdict == Verdict::Unexplained);
        first.is_some_and(|structure| structure.channel == channel.name())
    }

    /// The same, and that it follows this column or a product or function of it.
    pub fn sees_following(&self, channel: Channel, column: &str) -> bool {
        let names =
            |text: &str| text.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).any(|word| word == column);
        self.sees_in(channel) && self.unexplained.first().is_some_and(|structure| names(&structure.regressor))
    }

    /// Whether this is what was to be said of a campaign.
    pub fn is_right(&self, truth: &Truth) -> bool {
        match truth.subject {
            Subject::Clean => !self.alarms(),
            Subject::One(id) => self.finds(id),
            Subject::Two(first, second) => self.has(first) && self.has(second),
            Subject::Unlisted(unlisted) => self.sees_in(unlisted.channel),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(json: &str) -> Answer {
        serde_json::from_str(json).expect("an answer")
    }

    #[test]
    fn a_first_effect_counts_and_a_second_does_not() {
        let found = answer(
            r#"{"verdict": "effect", "effects": [{"id": "rate"}, {"id": "bulldozing"}], "ambiguous_with": [],
                "unexplained": []}"#,
        );
        assert!(found.finds("rate") && found.first_alone("rate"));
        assert!(!found.finds("bulldozing"));
        assert!(found.has("rate") && found.has("bulldozing") && !found.has("crosstalk"));
    }

    #[test]
    fn three_may_be_left_open_and_four_may_not() {
        let open = |others: &str| {
            answer(&format!(
                r#"{{"verdict": "ambiguous", "effects": [{{"id": "rate"}}], "ambiguous_with": [{others}],
                    "unexplained": []}}"#
            ))
        };
        let three = open(r#""crosstalk", "bulldozing", "rate""#);
        assert!(three.finds("rate") && three.finds("bulldozing") && !three.first_alone("rate"));
        let four = open(r#""crosstalk", "bulldozing", "force-bias""#);
        assert!(!four.finds("rate") && !four.finds("bulldozing"));
    }

    #[test]
    fn structure_counts_only_where_the_verdict_says_so() {
        let of = |verdict: &str| {
            answer(&format!(
                r#"{{"verdict": "{verdict}", "effects": [], "ambiguous_with": [],
                    "unexplained": [{{"channel": "torque_nm", "regressor": "slip*temperature_c"}}]}}"#
            ))
        };
        let seen = of("unexplained");
        assert!(seen.sees_in(Channel::Torque) && !seen.sees_in(Channel::Sinkage));
        assert!(seen.sees_following(Channel::Torque, "temperature_c"));
        assert!(!seen.sees_following(Channel::Torque, "temperature"));
        assert!(!of("none").sees_in(Channel::Torque) && !of("none").alarms());
    }
}
