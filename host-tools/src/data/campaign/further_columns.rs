//! Columns that the format does not name.

use crate::data::misspelling::column_meant;

use super::Channel;

/// What is said of each whose name is nearly that of a channel which the table lacks.
pub(super) fn misspelt(header: &[String]) -> impl Iterator<Item = String> + '_ {
    let has = |name: &str| header.iter().any(|column| column == name);
    let missing = Channel::ALL.into_iter().filter(|channel| !has(channel.name())).collect();
    nearly_named(header, missing)
}

/// What is said of each whose name is nearly that of one of these channels, which the table lacks.
pub fn nearly_named(header: &[String], missing: Vec<Channel>) -> impl Iterator<Item = String> + '_ {
    let further = header.iter().filter(|name| Channel::from_name(name).is_none() && *name != "run");
    further.filter_map(move |name| {
        let meant = column_meant(name, missing.iter().map(|channel| channel.name()))?;
        Some(format!("The table has a column `{name}` and none `{meant}`: if that is meant, it is not read as such."))
    })
}
