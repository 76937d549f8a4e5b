//! Numbers of the command line, with their ranges.

use std::str::FromStr;

/// A finite number of 0 or more.
///
/// # Errors
/// What was expected.
pub fn not_negative(text: &str) -> Result<f64, String> {
    let number = f64::from_str(text).ok().filter(|number| *number >= 0.0 && number.is_finite());
    number.ok_or_else(|| "expected a number of 0 or more".to_owned())
}

/// A finite number above 0.
///
/// # Errors
/// What was expected.
pub fn above_zero(text: &str) -> Result<f64, String> {
    not_negative(text).ok().filter(|number| *number > 0.0).ok_or_else(|| "expected a number above 0".to_owned())
}

/// A number above 0, at most `most`.
///
/// # Errors
/// What was expected.
pub fn above_zero_at_most(text: &str, most: f64) -> Result<f64, String> {
    let number = above_zero(text).ok().filter(|number| *number <= most);
    number.ok_or_else(|| format!("expected a number above 0, at most {most}"))
}
