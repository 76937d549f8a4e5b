//! The header of a table: each column's name, once.

/// What is wrong with a header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HeaderError {
    /// The column, from 1.
    pub column: u64,
    /// What was expected.
    pub message: String,
}

/// What parts columns in other tables, as it is told and as it is.
const OTHER_SEPARATORS: [(&str, char); 2] = [("semicolons", ';'), ("tabs", '\t')];

/// The names of the columns, blanks around them taken off.
///
/// # Errors
/// Where something else than commas seems to part the columns, there are remarks in place of names, a column without a name, or a name twice.
pub fn column_names<'a>(fields: impl Iterator<Item = &'a str>) -> Result<Vec<String>, HeaderError> {
    let names: Vec<String> = fields.map(|name| name.trim().to_owned()).collect();
    if let [all] = names.as_slice()
        && let Some((shown, _)) = OTHER_SEPARATORS.iter().find(|(_, separator)| all.contains(*separator))
    {
        return Err(HeaderError { column: 1, message: format!("columns are parted by {shown}: expected commas") });
    }
    for (place, name) in names.iter().enumerate() {
        let error = |message: String| Err(HeaderError { column: place as u64 + 1, message });
        if place == 0 && name.starts_with('#') {
            return error("remarks: expected the names of the columns ahead of everything else".to_owned());
        }
        if name.is_empty() {
            return error("this column has no name: expected one in the header".to_owned());
        }
        if names.iter().take(place).any(|other| other == name) {
            return error(format!("a second column is named `{name}`: expected each name once"));
        }
    }
    Ok(names)
}
