//! Which rows stay where a campaign has more than can be fitted within seconds.

/// Rows to which the runs are thinned together, but for at least one of each run; of more runs, as of rows that are runs of their own, so many
/// stay.
const MOST_ROWS: usize = 240;

/// The runs of which something stays.
pub fn some_runs<T>(runs: &[T]) -> Vec<&T> {
    scattered(runs, MOST_ROWS, 0).collect()
}

/// The rows of a run that stay, over all of it, where all runs together have `all` rows.
pub fn thinned(run: &[usize], all: usize, number: usize) -> impl Iterator<Item = usize> {
    let share = (run.len() * MOST_ROWS + all / 2) / all;
    scattered(run, share.max(1), number).copied()
}

/// So many of some things, one of each of as many equal parts of them; all where there are fewer. Which one of a part changes from part to
/// part by the golden section, and so it does from one number to the next: what comes round in step, as six wheels at each instant do, would
/// else be seen at one and the same place of it.
fn scattered<T>(all: &[T], most: usize, number: usize) -> impl Iterator<Item = &T> {
    const GOLDEN_SECTION: f64 = 0.618_033_988_749_894_9;
    let stay = most.min(all.len());
    (0..stay).map(move |part| {
        let [begin, end] = [part, part + 1].map(|part| part * all.len() / stay);
        let within = (GOLDEN_SECTION * (part + number) as f64).fract();
        &all[begin + (within * (end - begin) as f64) as usize]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_runs_some_of_every_part_stay() {
        let rows: Vec<usize> = (0..1000).collect();
        let kept: Vec<_> = scattered(&rows, MOST_ROWS, 0).copied().collect();
        assert_eq!((kept.len(), kept[0], kept[1], kept[MOST_ROWS - 1]), (MOST_ROWS, 0, 6, 998));
        assert!(kept.windows(2).all(|pair| (1..9).contains(&(pair[1] - pair[0]))));
        assert_eq!(scattered(&rows[..7], MOST_ROWS, 3).count(), 7);
    }

    #[test]
    fn runs_are_thinned_and_none_is_lost() {
        let rows: Vec<usize> = (10..20).collect();
        let stay = |run: &[usize], all: usize| thinned(run, all, 5).collect::<Vec<_>>();
        assert_eq!(stay(&rows, MOST_ROWS), rows);
        assert_eq!(stay(&rows, 2 * MOST_ROWS), [10, 13, 14, 17, 19]);
        assert_eq!(stay(&rows, 4 * MOST_ROWS / 3), [10, 11, 12, 14, 15, 16, 17, 18]);
        assert_eq!(stay(&rows[..1], 1000 * MOST_ROWS), [10]);
        assert!(stay(&[], MOST_ROWS).is_empty());
    }

    /// Six wheels at each instant: whether the instants of a run, or runs of one instant, are too many.
    #[test]
    fn what_comes_round_in_step_is_seen_at_all_its_places() {
        let of_wheel = |wheel: usize, kept: &[usize]| kept.iter().filter(|row| *row % 6 == wheel).count();
        let instants: Vec<usize> = (0..6 * MOST_ROWS).collect();
        let of_one_run: Vec<_> = thinned(&instants, instants.len(), 0).collect();
        let runs: Vec<Vec<usize>> = instants.chunks(6).map(<[usize]>::to_vec).collect();
        let of_each: Vec<_> =
            runs.iter().enumerate().flat_map(|(number, run)| thinned(run, instants.len(), number)).collect();
        for kept in [of_one_run, of_each] {
            assert!((0..6).all(|wheel| of_wheel(wheel, &kept).abs_diff(MOST_ROWS / 6) < 8), "{kept:?}");
        }
    }
}
