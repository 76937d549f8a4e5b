//! Columns that the format does not name.

use crate::data::misspelling::column_meant;

use super::Channel;

/// What is said of each whose name is nearly that of a channel which the table lacks.
pub(super) fn misspelt(header: &[String]) -> impl Iterator<Item = String> + '_ {
    let has = |name: &str| header.iter().any(|column| column == name);
    let missing = move || Channel::ALL.map(Channel::name).into_iter().filter(move |name| !has(name));
    let further = header.iter().filter(|name| Channel::from_name(name).is_none() && *name != "run");
    further.filter_map(move |name| {
        let meant = column_meant(name, missing())?;
        Some(format!("The table has a column `{name}` and none `{meant}`: if that is meant, it is not read as such."))
    })
}
