//! What comes nearest to explaining what a model leaves, where nothing earns its place, and why it does not.

use super::forward::Selected;
use super::measurements::column_name;

/// The chance from which what comes nearest says nothing.
const ANYHOW: f64 = 0.3;
/// The least share of searches that is told in digits, percent.
const LEAST_PERCENT: f64 = 0.1;

/// A candidate or a column that comes nearest.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// The effect's id, or the channel and the column.
    pub what: String,
    /// The chance of as much in a search.
    pub chance: f64,
    /// What speaks against it where that chance does not.
    pub but: Option<&'static str>,
}

/// The candidate and the column that come nearest, where chance does not do as much anyhow.
pub fn nearest(selected: &Selected<'_>) -> Vec<Nearest> {
    let answered = selected.last.iter().flat_map(|step| &step.ranking).filter(|judged| judged.held_out.has_answer());
    let candidate = answered.min_by(|a, b| a.p_value.total_cmp(&b.p_value)).map(|judged| Nearest {
        what: judged.id().to_owned(),
        chance: judged.p_value,
        but: judged.why_not(),
    });
    let column = selected.guilty.as_ref().map(|structure| Nearest {
        what: format!("{} against {}", column_name(structure.channel), structure.regressor()),
        chance: structure.p_value,
        but: structure.why_not(),
    });
    candidate.into_iter().chain(column).filter(|nearest| nearest.chance < ANYHOW).collect()
}

/// Why nothing explains what is left, for the end of a sentence about it.
pub fn no_explanation(nearest: &[Nearest]) -> &'static str {
    if nearest.iter().any(|nearest| nearest.but.is_some()) {
        "no candidate and no column explains that and stands every test"
    } else {
        "no candidate and no column explains that beyond chance"
    }
}

/// The sentence that names them; none where none is near.
pub fn in_words(nearest: &[Nearest]) -> String {
    let one = |Nearest { what, chance, but }: &Nearest| {
        let percent = 100.0 * chance;
        let share =
            if percent < LEAST_PERCENT { format!("less than {LEAST_PERCENT} %") } else { format!("{percent:.1} %") };
        let but = but.map_or_else(String::new, |but| format!(", but {but}"));
        format!("{what} (by chance in {share} of searches{but})")
    };
    match nearest {
        [] => String::new(),
        all => format!(" Nearest comes {}.", all.iter().map(one).collect::<Vec<_>>().join(", and ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What chance would seldom do, and is none all the same, has its reason beside it.
    #[test]
    fn what_comes_nearest_is_told_with_what_speaks_against_it() {
        let of = |what: &str, chance: f64, but| Nearest { what: what.to_owned(), chance, but };
        let by_chance = [of("crosstalk", 0.123, None)];
        assert_eq!(no_explanation(&by_chance), "no candidate and no column explains that beyond chance");
        assert_eq!(in_words(&by_chance), " Nearest comes crosstalk (by chance in 12.3 % of searches).");
        let refused = [of("rate", 1e-9, Some("it predicts nothing")), of("torque_nm against pass", 0.04, None)];
        assert!(!no_explanation(&refused).contains("chance"));
        assert_eq!(
            in_words(&refused),
            " Nearest comes rate (by chance in less than 0.1 % of searches, but it predicts nothing), and torque_nm against \
             pass (by chance in 4.0 % of searches)."
        );
        assert_eq!(in_words(&[]), "");
    }
}
