//! Names that are nearly another.

use strsim::jaro_winkler;

/// From this likeness of two names on, of 1, one is taken for a misspelling of the other.
const MISSPELLED: f64 = 0.85;

/// The one of these names that a name is most like, where it may be a misspelling of it.
pub fn nearest(name: &str, names: impl IntoIterator<Item = &'static str>) -> Option<&'static str> {
    let alike = names.into_iter().map(|other| (other, jaro_winkler(name, other)));
    alike.filter(|(_, likeness)| *likeness >= MISSPELLED).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(other, _)| other)
}
