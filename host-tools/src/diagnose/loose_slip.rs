//! Slips that are swept and scatter about the sweep, where nobody states how noisily they are read.
//!
//! What is taken for their noise then is less than they scatter by, and what is left of a force follows their errors. A clock tells where the
//! sweep is better than they do, so that forces seem to follow it: no structure is told from that.

use crate::data::campaign::{Campaign, Channel};

use super::fit::Reading;
use super::measurements::Measurements;
use super::noise::{SLIP_STD, within_runs};
use super::usable_rows::UsableRow;

/// Times the noise that is taken from which slips scatter by more; and greatest share of their spread within runs, beyond which they are in no
/// order and may be as they were set.
const TIMES: f64 = 2.0;
const SHARE: f64 = 0.5;
/// Fewest rows of a run in which a clock is seen to go on.
const ROWS: usize = 3;

/// What such slips scatter by; none where they do not, or their noise is stated.
pub fn loose_slip(campaign: &Campaign, rows: &[UsableRow]) -> Option<f64> {
    if campaign.noise.of(Channel::Slip).is_some_and(|std| std > 0.0) {
        return None;
    }
    let scatter = within_runs(campaign, Reading::Slip, rows)?;
    (scatter > TIMES * SLIP_STD && scatter < SHARE * spread_within_runs(campaign, rows)).then_some(scatter)
}

/// Standard deviation of the slips about the means of their runs.
fn spread_within_runs(campaign: &Campaign, rows: &[UsableRow]) -> f64 {
    let run = |row: &UsableRow| &campaign.rows()[row.place].run_in_file;
    let squares = rows.chunk_by(|one, other| run(one) == run(other)).map(|rows| {
        let slips = || rows.iter().filter_map(|row| row.readings[Reading::Slip.index()]);
        let mean = slips().sum::<f64>() / slips().count() as f64;
        slips().map(|slip| (slip - mean).powi(2)).sum::<f64>()
    });
    (squares.sum::<f64>() / rows.len() as f64).sqrt()
}

/// Whether a column only rises, or only falls, in every run: it tells the time.
pub fn is_clock(measurements: &Measurements, values: &[Option<f64>]) -> bool {
    let goes_on = |run: &Vec<usize>| {
        let steps = run.windows(2).map(|pair| Some(values[pair[1]]? - values[pair[0]]?));
        let steps: Option<Vec<f64>> = steps.collect();
        steps.is_some_and(|steps| steps.iter().all(|step| *step > 0.0) || steps.iter().all(|step| *step < 0.0))
    };
    let mut long = measurements.rows_of_run.iter().filter(|run| run.len() >= ROWS).peekable();
    long.peek().is_some() && long.all(goes_on)
}

/// What is said of it.
pub fn in_words(scatter: f64) -> String {
    format!(
        "slip scatters by {scatter:.3} about how it goes on within runs, and its noise is not stated: it is taken as {SLIP_STD}, and \
         nothing is said to follow t_s or a column that only rises or falls in a run, which tells the slip better than its readings do; \
         state [noise] slip."
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Forty slips in some order, with errors of that size and a column that rises; and what is stated.
    fn swept(error: f64, stated: &str, order: fn(usize) -> usize) -> Measurements {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let row = |k: usize| {
            let noise: f64 = StandardNormal.sample(&mut random);
            let slip = 0.1 + 0.01 * order(k) as f64 + error * noise;
            format!("a,{k},{slip},{},{},{}\n", 60.0 + 0.1 * k as f64, 5.0 + 0.1 * k as f64, 0.1 * k as f64)
        };
        let rows: String = (0..40).map(row).collect();
        let toml =
            format!("name = \"a\"\nkind = \"measured\"\n[wheel]\nradius_m = 0.1\nwidth_m = 0.1\n[noise]\n{stated}");
        let csv = format!("run,t_s,slip,load_n,drawbar_pull_n,travel_m\n{rows}");
        let campaign = Campaign::parse(Path::new("a.csv"), &csv, &toml).expect("a campaign");
        Measurements::of(&campaign, false).expect("rows")
    }

    #[test]
    fn slips_are_loose_where_they_scatter_and_nobody_says_so() {
        let of = |error, stated| swept(error, stated, |k| k).loose_slip;
        let scatter = of(0.02, "").expect("loose");
        assert!((0.01..0.04).contains(&scatter), "{scatter}");
        assert_eq!([of(0.02, "slip = 0.02\n"), of(0.002, "")], [None; 2]);
        // In no order: as they were set.
        assert_eq!(swept(0.02, "", |k| 17 * k % 40).loose_slip, None);
    }

    #[test]
    fn a_column_that_only_rises_is_a_clock() {
        let measurements = swept(0.02, "", |k| k);
        let rising: Vec<_> = (0..40).map(|k| Some(f64::from(k))).collect();
        assert!(is_clock(&measurements, &rising));
        let slips: Vec<_> = measurements.rows.iter().map(|row| row.readings[Reading::Slip.index()]).collect();
        assert!(!is_clock(&measurements, &slips));
    }
}
