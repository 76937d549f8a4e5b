//! Formulas of a small grammar: a scale of the channel times shapes of dimensionless groups.

use super::measurements::median;
use crate::statistics::sorted;

/// Values that a group must take for its shapes to differ: with two, every shape is a line.
const FEW_VALUES: usize = 2;
/// Where a group saturates, in units of its middle size.
const SATURATIONS: [f64; 2] = [0.3, 1.0];
/// Share of its largest value by which a group that saturates may lie below zero: noise about zero.
const BELOW_ZERO: f64 = 0.1;
/// Shapes of the two factors of a product.
const PRODUCTS: [(Shape, Shape); 5] = [
    (Shape::Line, Shape::Line),
    (Shape::Line, Shape::Square),
    (Shape::Square, Shape::Line),
    (Shape::Root, Shape::Line),
    (Shape::Line, Shape::Root),
];

/// A dimensionless number of each row.
#[derive(Debug, Clone)]
pub struct Group {
    /// How it is written.
    pub symbol: String,
    /// The column that it is made of.
    pub column: String,
    /// Its value in each row.
    pub values: Vec<f64>,
    /// Whether powers of it make sense: those of a sine do not.
    pub has_shapes: bool,
}

/// What a group is put through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// √|x|.
    Root,
    /// x.
    Line,
    /// x².
    Square,
    /// x³.
    Cube,
    /// 1 − exp(−x / x₀).
    Saturation(f64),
}

impl Shape {
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Root => x.abs().sqrt(),
            Self::Line => x,
            Self::Square => x * x,
            Self::Cube => x * x * x,
            Self::Saturation(middle) => -(-x / middle).exp_m1(),
        }
    }

    /// Symbols that it adds to those of its group.
    fn symbols(self) -> usize {
        match self {
            Self::Line => 0,
            Self::Root | Self::Square => 1,
            Self::Cube | Self::Saturation(_) => 2,
        }
    }

    fn written(self, group: &Group) -> String {
        let symbol = &group.symbol;
        let inside = symbol.strip_prefix('(').and_then(|symbol| symbol.strip_suffix(')')).unwrap_or(symbol);
        match self {
            Self::Root if group.values.iter().any(|value| *value < 0.0) => format!("sqrt(|{inside}|)"),
            Self::Root => format!("sqrt({inside})"),
            Self::Line => symbol.clone(),
            Self::Square => format!("{symbol}^2"),
            Self::Cube => format!("{symbol}^3"),
            Self::Saturation(middle) => format!("(1 - exp(-{symbol}/{}))", figure(middle)),
        }
    }
}

/// A term of a law: its factors, each a group (by its place) and a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Term(Vec<(usize, Shape)>);

impl Term {
    /// Symbols that it is written with, beside coefficient and scale.
    pub fn symbols(&self) -> usize {
        self.0.iter().map(|(_, shape)| 1 + shape.symbols()).sum::<usize>() + self.0.len().saturating_sub(1)
    }

    /// Its value in each row.
    pub fn values(&self, groups: &[Group], scale: &[f64]) -> Vec<f64> {
        let at = |(row, scale): (usize, &f64)| {
            self.0.iter().map(|(group, shape)| shape.of(groups[*group].values[row])).product::<f64>() * scale
        };
        scale.iter().enumerate().map(at).collect()
    }

    /// How it is written, without coefficient and scale.
    pub fn written(&self, groups: &[Group]) -> String {
        self.0.iter().map(|(group, shape)| shape.written(&groups[*group])).collect::<Vec<_>>().join(" ")
    }
}

/// Every term of the grammar: each group in each shape, and products of two groups.
pub fn terms(groups: &[Group]) -> Vec<Term> {
    let shapes: Vec<Vec<Shape>> = groups.iter().map(shapes).collect();
    let mut found = Vec::new();
    for (one, of_one) in shapes.iter().enumerate() {
        found.extend(of_one.iter().map(|shape| Term(vec![(one, *shape)])));
        for (other, of_other) in shapes.iter().enumerate().skip(one + 1) {
            let possible = PRODUCTS.iter().filter(|(a, b)| of_one.contains(a) && of_other.contains(b));
            found.extend(possible.map(|(a, b)| Term(vec![(one, *a), (other, *b)])));
        }
    }
    found
}

fn shapes(group: &Group) -> Vec<Shape> {
    let mut distinct = sorted(group.values.iter().copied());
    distinct.dedup();
    let mut shapes = vec![Shape::Line];
    if !group.has_shapes || distinct.len() <= FEW_VALUES {
        return shapes;
    }
    shapes.extend([Shape::Root, Shape::Square, Shape::Cube]);
    let (low, high) = (distinct[0], distinct[distinct.len() - 1]);
    let middle = median(distinct).unwrap_or(0.0);
    if low >= -BELOW_ZERO * high && middle > 0.0 {
        shapes.extend(SATURATIONS.map(|share| Shape::Saturation(rounded(share * middle))));
    }
    shapes
}

/// At least three digits that mean something, without zeros at the end; all of those before the point up to a million.
pub fn figure(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    if !(-4..=5).contains(&exponent) {
        return format!("{value:.2e}");
    }
    let digits = usize::try_from(2 - exponent).unwrap_or(0);
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A number as [`figure`] writes it, so that what is written is what was computed with.
pub fn rounded(value: f64) -> f64 {
    figure(value).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(symbol: &str, values: &[f64]) -> Group {
        Group { symbol: symbol.to_owned(), column: symbol.to_owned(), values: values.to_vec(), has_shapes: true }
    }

    #[test]
    fn figures_have_three_digits() {
        for (value, text) in
            [(24.13, "24.1"), (0.031_25, "0.0312"), (-3.0, "-3"), (2.0e-7, "2.00e-7"), (1234.0, "1234")]
        {
            assert_eq!(figure(value), text);
        }
    }

    #[test]
    fn a_term_is_written_as_it_is_computed() {
        let groups = [group("slip", &[0.25, 0.5, 1.0]), group("x", &[-1.0, 2.0, 3.0])];
        let term = Term(vec![(0, Shape::Root), (1, Shape::Square)]);
        assert_eq!(term.written(&groups), "sqrt(slip) x^2");
        assert_eq!(term.values(&groups, &[2.0, 1.0, 1.0])[0], 1.0);
        assert_eq!(term.symbols(), 5);
        let saturation = Term(vec![(0, Shape::Saturation(0.5))]);
        assert_eq!(saturation.written(&groups), "(1 - exp(-slip/0.5))");
        assert!((saturation.values(&groups, &[1.0; 3])[1] - (1.0 - (-1.0_f64).exp())).abs() < 1e-15);
    }

    #[test]
    fn two_values_make_no_curve_and_signs_no_saturation() {
        let groups = [group("pass", &[0.0, 1.0, 0.0]), group("x", &[-1.0, 2.0, 3.0])];
        // pass; x, √|x|, x², x³; and of pass only the line in products: with x, x² and √|x|.
        assert_eq!(terms(&groups).len(), 1 + 4 + 3);
    }
}
