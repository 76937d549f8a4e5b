//! Loads that come in set levels.

/// A step to the next reading beyond this share of the load is a step to another level.
const STEP_SHARE: f64 = 0.1;
/// Spread of a level, one standard deviation over its mean, beyond which it is none.
const WIDEST_SHARE: f64 = 0.15;
/// Distance between levels over their spread, one standard deviation, below which they are none.
const LEAST_DISTANCE: f64 = 6.0;
/// Rows of a level.
const LEAST_ROWS: usize = 4;
/// Runs of a level.
const LEAST_RUNS: usize = 2;
/// Share of the rows that must be at a level.
const LEAST_SHARE: f64 = 0.8;

/// A reading of the load, N, and the run that it is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadReading {
    /// Number of the run.
    pub run: usize,
    /// N.
    pub load_n: f64,
}

/// Levels of load.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadLevels {
    /// The mean of each, N, rising.
    pub means_n: Vec<f64>,
    /// The level of each reading; none for a stray one.
    pub of_reading: Vec<Option<usize>>,
}

impl LoadLevels {
    /// The levels of some readings; none where the load is spread out.
    pub fn of(readings: &[LoadReading]) -> Option<Self> {
        let mut order: Vec<usize> = (0..readings.len()).collect();
        order.sort_by(|a, b| readings[*a].load_n.total_cmp(&readings[*b].load_n));
        let is_step = |a: &usize, b: &usize| {
            let (low_n, high_n) = (readings[*a].load_n, readings[*b].load_n);
            high_n - low_n > STEP_SHARE * low_n.abs()
        };
        let groups = order.chunk_by(|a, b| !is_step(a, b));
        let levels: Vec<Level> = groups.filter_map(|group| Level::of(readings, group)).collect();
        let rows: usize = levels.iter().map(|level| level.rows.len()).sum();
        let apart =
            |pair: &[Level]| pair[1].mean_n - pair[0].mean_n > LEAST_DISTANCE * pair[0].spread_n.max(pair[1].spread_n);
        if rows == 0 || (rows as f64) < LEAST_SHARE * readings.len() as f64 || !levels.windows(2).all(apart) {
            return None;
        }
        let mut of_reading = vec![None; readings.len()];
        for (number, level) in levels.iter().enumerate() {
            level.rows.iter().for_each(|row| of_reading[*row] = Some(number));
        }
        Some(Self { means_n: levels.iter().map(|level| level.mean_n).collect(), of_reading })
    }
}

struct Level {
    mean_n: f64,
    spread_n: f64,
    rows: Vec<usize>,
}

impl Level {
    fn of(readings: &[LoadReading], rows: &[usize]) -> Option<Self> {
        let mut runs: Vec<usize> = rows.iter().map(|row| readings[*row].run).collect();
        runs.sort_unstable();
        runs.dedup();
        let count = rows.len() as f64;
        let mean_n = rows.iter().map(|row| readings[*row].load_n).sum::<f64>() / count;
        let squares: f64 = rows.iter().map(|row| (readings[*row].load_n - mean_n).powi(2)).sum();
        let spread_n = (squares / (count - 1.0).max(1.0)).sqrt();
        let is_level =
            rows.len() >= LEAST_ROWS && runs.len() >= LEAST_RUNS && mean_n > 0.0 && spread_n < WIDEST_SHARE * mean_n;
        is_level.then(|| Self { mean_n, spread_n, rows: rows.to_vec() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(loads_n: impl IntoIterator<Item = f64>) -> Vec<LoadReading> {
        loads_n.into_iter().enumerate().map(|(run, load_n)| LoadReading { run, load_n }).collect()
    }

    #[test]
    fn weights_that_repeat_are_levels_and_a_stray_reading_is_none() {
        let loads = [49.0, 100.5, 50.0, 51.0, 99.5, 100.0, 50.0, 70.0, 101.0, 99.0];
        let levels = LoadLevels::of(&readings(loads)).expect("two levels");
        assert_eq!(levels.means_n, [50.0, 100.0]);
        assert_eq!(levels.of_reading[..2], [Some(0), Some(1)]);
        assert_eq!(levels.of_reading[7], None);
    }

    #[test]
    fn loads_that_are_spread_out_are_no_levels() {
        // Evenly from 20 to 100 N, and by accident in loose heaps.
        assert_eq!(LoadLevels::of(&readings((0..40).map(|place| 20.0 + 2.0 * f64::from(place)))), None);
        let heaps = [20.0, 21.5, 23.0, 24.5, 30.0, 32.0, 34.0, 36.0, 43.0, 46.0, 49.0, 52.0];
        assert_eq!(LoadLevels::of(&readings(heaps)), None);
    }

    #[test]
    fn a_level_of_one_run_is_none() {
        let loads = [50.0, 50.1, 49.9, 50.0, 50.2];
        let one_run: Vec<_> = loads.into_iter().map(|load_n| LoadReading { run: 0, load_n }).collect();
        assert_eq!(LoadLevels::of(&one_run), None);
        assert!(LoadLevels::of(&readings(loads)).is_some());
    }
}
