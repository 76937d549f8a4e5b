//! Numbers with as many digits as their uncertainty bears.

use crate::diagnose::document::Estimate;
use crate::report::draw::number;

/// `0.30 ± 0.03`: both as far as the standard deviation has digits that mean something.
pub fn with_std(Estimate { value, std }: Estimate, factor: f64) -> String {
    let (value, std) = (factor * value, (factor * std).abs());
    if !value.is_finite() {
        return "–".to_owned();
    }
    if !(std.is_finite() && std > 0.0) {
        return significant(value, 3);
    }
    // 0.28 and 0.31 differ in what they mean; 0.71 and 0.68 do not.
    let leading = std / 10_f64.powf(std.log10().floor());
    let digits = decimals(std, if leading < 3.0 { 2 } else { 1 });
    format!("{} ± {}", number(value, digits, false), number(std, digits, false))
}

/// A number to so many digits that mean something.
pub fn significant(value: f64, digits: i32) -> String {
    number(value, decimals(value, digits), false)
}

/// An error beside its noise, both to the second digit of the noise.
pub fn beside_noise(error: f64, noise: f64) -> String {
    if noise > 0.0 { number(error, decimals(noise, 2), false) } else { significant(error, 3) }
}

/// A bound: three digits, without zeros at the end.
pub fn bound(value: f64) -> String {
    let text = significant(value, 3);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A probability: `0.03`, `4 × 10⁻⁷`.
pub fn probability(value: f64) -> String {
    if value.is_nan() || value >= 1e-3 {
        return significant(value, 2);
    }
    if value <= 0.0 {
        return "0".to_owned();
    }
    let exponent = value.log10().floor() as i32;
    let digit = (value / 10_f64.powi(exponent)).round();
    // 9.7 × 10⁻⁷ rounds to 10 × 10⁻⁷.
    let (digit, exponent) = if digit >= 10.0 { (1.0, exponent + 1) } else { (digit, exponent) };
    let raised: String = exponent.to_string().chars().map(superscript).collect();
    if digit == 1.0 { format!("10{raised}") } else { format!("{digit} × 10{raised}") }
}

/// How much smaller or larger it became, in percent.
pub fn change(before: f64, after: f64) -> String {
    let percent = 100.0 * (after / before - 1.0);
    if percent.is_finite() { format!("{} %", number(percent, 0, true)) } else { "–".to_owned() }
}

/// Places behind the point at which the digit number `digits` of a number stands; 0 where that is before the point.
pub fn decimals(value: f64, digits: i32) -> usize {
    let size = value.abs();
    if size == 0.0 {
        return 0;
    }
    usize::try_from(digits - 1 - size.log10().floor() as i32).unwrap_or(0).min(9)
}

fn superscript(character: char) -> char {
    match character {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_end_where_the_uncertainty_begins() {
        let shown = |value, std| with_std(Estimate { value, std }, 1.0);
        assert_eq!(shown(0.30123, 0.0312), "0.30 ± 0.03");
        assert_eq!(shown(0.30123, 0.0278), "0.301 ± 0.028");
        assert_eq!(shown(-1234.5, 56.7), "−1234 ± 57");
        assert_eq!(["1", "10", "0.25"], [1.0, 10.0, 0.25].map(bound));
        assert_eq!(["4.10", "0.61"], [(4.1, 0.7), (0.612, 0.6)].map(|(error, noise)| beside_noise(error, noise)));
        assert_eq!(shown(0.5, 0.0), "0.500");
        assert_eq!(shown(f64::NAN, 0.1), "–");
        assert_eq!(with_std(Estimate { value: 0.0114, std: 0.001 }, 1e3), "11.4 ± 1.0");
    }

    #[test]
    fn small_probabilities_are_powers_of_ten() {
        assert_eq!(["0.030", "4 × 10⁻⁷", "10⁻⁶", "10⁻¹²"], [0.03, 4.1e-7, 9.7e-7, 1e-12].map(probability));
        assert_eq!(probability(f64::NAN), "–");
        assert_eq!(change(4.1, 1.8), "−56 %");
    }
}
