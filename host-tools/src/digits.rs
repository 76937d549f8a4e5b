//! Numbers for people.

/// A number rounded to so many significant digits.
pub fn significant(value: f64, digits: usize) -> f64 {
    let after_first = digits.saturating_sub(1);
    format!("{value:.after_first$e}").parse().unwrap_or(value)
}

/// A unit as it follows a number; nothing of a number without one, whose unit is `-`.
pub fn spaced_unit(unit: &str) -> String {
    if unit == "-" { String::new() } else { format!(" {unit}") }
}

/// So many of something: `1 frame`, `2 frames`.
pub fn counted(number: u64, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::{counted, significant, spaced_unit};

    #[test]
    fn a_number_without_unit_stands_alone() {
        assert_eq!(["N", "-"].map(spaced_unit), [" N", ""]);
    }

    #[test]
    fn one_is_no_plural() {
        assert_eq!([0, 1, 2].map(|number| counted(number, "query", "queries")), ["0 queries", "1 query", "2 queries"]);
    }

    #[test]
    fn numbers_keep_so_many_digits() {
        assert_eq!(significant(0.048_76, 2), 0.049);
        assert_eq!(significant(-1234.5, 3), -1230.0);
        assert_eq!(significant(0.0, 2), 0.0);
        assert!(significant(f64::NAN, 2).is_nan());
    }
}
