//! A share of cases, with how well that many cases know it.

use std::fmt;

/// So many of so many.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Share {
    /// Those that count.
    pub hits: usize,
    /// All.
    pub of: usize,
}

impl Share {
    /// The share of cases of which something holds.
    pub fn of<T>(cases: impl IntoIterator<Item = T>, holds: impl Fn(&T) -> bool) -> Self {
        cases.into_iter().fold(Self::default(), |share, case| Self {
            hits: share.hits + usize::from(holds(&case)),
            of: share.of + 1,
        })
    }

    /// The interval in which the true share lies at a confidence of 95 % (Wilson 1927, J. Am. Stat. Assoc. 22:209–212);
    /// 0 … 1 of no cases.
    pub fn interval(&self) -> (f64, f64) {
        const Z: f64 = 1.959_963_984_540_054;
        if self.of == 0 {
            return (0.0, 1.0);
        }
        let (n, p) = (self.of as f64, self.hits as f64 / self.of as f64);
        let scale = 1.0 / (1.0 + Z * Z / n);
        let middle = scale * (p + 0.5 * Z * Z / n);
        let half = scale * Z * libm::sqrt(p * (1.0 - p) / n + 0.25 * Z * Z / (n * n));
        ((middle - half).max(0.0), (middle + half).min(1.0))
    }
}

impl fmt::Display for Share {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.of == 0 {
            return formatter.write_str("–");
        }
        let (low, high) = self.interval();
        let percent = 100.0 * self.hits as f64 / self.of as f64;
        write!(formatter, "{percent:.1} % ({}/{}, 95 %: {:.1}–{:.1})", self.hits, self.of, 100.0 * low, 100.0 * high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Newcombe 1998, Statistics in Medicine 17:857–872, table I, method 3: 81/263, 15/148, 0/20, 1/29.
    #[test]
    fn intervals_of_the_literature() {
        for (hits, of, low, high) in
            [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)]
        {
            let found = Share { hits, of }.interval();
            assert!((found.0 - low).abs() < 1e-4 && (found.1 - high).abs() < 1e-4, "{hits}/{of}: {found:?}");
        }
    }
}
