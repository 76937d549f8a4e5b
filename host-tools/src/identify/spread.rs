//! How the true slips and loads of the rows of a mean scatter.

use super::combine::Sample;

/// Variances exceed that of the noise by chance by as many of their standard errors, and no more.
const BY_CHANCE: f64 = 2.0;

/// No corner is under less than this share of the least load of the rows: under nothing no wheel rolls.
const LEAST_SHARE: f64 = 0.5;

/// Scatter of slip and load about their means, what noise explains taken off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Standard deviation of the slip.
    slip: f64,
    /// Change of the load with a standard deviation of the slip, N.
    load_by_slip_n: f64,
    /// Standard deviation of the load behind a given slip, N.
    load_n: f64,
    /// The least load of the rows, N.
    least_load_n: f64,
}

impl Spread {
    /// Rows all alike.
    pub const NONE: Self = Self { slip: 0.0, load_by_slip_n: 0.0, load_n: 0.0, least_load_n: 0.0 };

    /// Of the rows of a group; `noise` is one standard deviation of slip and of load (N) in one row.
    pub fn of(rows: &[Sample], noise: [f64; 2]) -> Self {
        let count = rows.len() as f64;
        let mean = |of: &dyn Fn(&Sample) -> f64| rows.iter().map(of).sum::<f64>() / count;
        let (slip, load_n) = (mean(&|row| row.slip), mean(&|row| row.load_n));
        let beyond = |square: f64, std: f64| {
            let of_noise = std * std * (count - 1.0) / count;
            let is_noise = square <= of_noise * (1.0 + BY_CHANCE * (2.0 / count).sqrt());
            if is_noise { 0.0 } else { square - of_noise }
        };
        let of_slip = beyond(mean(&|row| (row.slip - slip).powi(2)), noise[0]);
        let of_load = beyond(mean(&|row| (row.load_n - load_n).powi(2)), noise[1]);
        let both = mean(&|row| (row.slip - slip) * (row.load_n - load_n));
        let slip_std = of_slip.sqrt();
        let by_slip = if of_slip > 0.0 { (both / slip_std).clamp(-of_load.sqrt(), of_load.sqrt()) } else { 0.0 };
        Self {
            slip: slip_std,
            load_by_slip_n: by_slip,
            load_n: (of_load - by_slip * by_slip).max(0.0).sqrt(),
            least_load_n: rows.iter().map(|row| row.load_n).fold(f64::INFINITY, f64::min),
        }
    }

    /// Whether the rows are all alike but for noise.
    pub fn is_none(&self) -> bool {
        self.slip == 0.0 && self.load_n == 0.0
    }

    /// States (slip, load in N), at most four, that have the means and the scatter: what is quadratic in slip and load has the same
    /// mean over them as over the rows.
    pub fn corners(&self, slip: f64, load_n: f64) -> Vec<(f64, f64)> {
        let sides = |is_spread: bool| if is_spread { [-1.0, 1.0].as_slice() } else { &[0.0] };
        let corner = |along: f64, across: f64| {
            let load_n = load_n + along * self.load_by_slip_n + across * self.load_n;
            ((slip + along * self.slip).clamp(-1.0, 1.0), load_n.max(LEAST_SHARE * self.least_load_n))
        };
        let along = sides(self.slip > 0.0).iter();
        along.flat_map(|along| sides(self.load_n > 0.0).iter().map(move |across| corner(*along, *across))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kapvik_firmware::terramechanics::effects::Conditions;

    fn sample(slip: f64, load_n: f64) -> Sample {
        let conditions = Conditions::default();
        Sample { t_s: 0.0, slip, load_n, drawbar_pull_n: None, torque_nm: None, sinkage_m: None, conditions }
    }

    #[test]
    fn corners_have_the_moments_of_the_rows() {
        let rows: Vec<Sample> = [(0.1, 45.0), (0.2, 60.0), (0.2, 80.0), (0.35, 90.0), (0.3, 50.0)]
            .map(|(slip, load_n)| sample(slip, load_n))
            .to_vec();
        let mean = |of: &dyn Fn(f64, f64) -> f64| rows.iter().map(|row| of(row.slip, row.load_n)).sum::<f64>() / 5.0;
        let (slip, load_n) = (mean(&|slip, _| slip), mean(&|_, load_n| load_n));
        let corners = Spread::of(&rows, [0.0, 0.0]).corners(slip, load_n);
        let quadratics: [&dyn Fn(f64, f64) -> f64; 5] = [
            &|slip, _| slip,
            &|_, load_n| load_n,
            &|slip, _| slip * slip,
            &|_, load_n| load_n * load_n,
            &|slip, load_n| slip * load_n,
        ];
        for of in quadratics {
            let over_corners =
                corners.iter().map(|(slip, load_n)| of(*slip, *load_n)).sum::<f64>() / corners.len() as f64;
            assert!((over_corners / mean(of) - 1.0).abs() < 1e-9, "{over_corners}, {}", mean(of));
        }
    }

    #[test]
    fn noise_is_no_spread() {
        let rows: Vec<Sample> = (0..50).map(|row| sample(if row % 2 == 0 { 0.19 } else { 0.21 }, 65.0)).collect();
        assert!(Spread::of(&rows, [0.01, 1.0]).is_none());
        assert!(!Spread::of(&rows, [0.005, 1.0]).is_none());
    }
}
