//! What all charts over time share.

use maud::{Markup, html};

use crate::report::draw::{Anchor, Pixels, Scale, band, path, text};

/// Width of every chart.
pub const WIDTH: f64 = 1100.0;
/// Room left of the plots, for the numbers of the axis.
pub const LEFT: f64 = 44.0;
/// Room right of the plots, for half of the last tick's number.
pub const RIGHT: f64 = 14.0;

/// The scale of time between two places.
pub fn scale((first_s, last_s): (f64, f64), pixels: Pixels) -> Scale {
    Scale::linear(first_s, if last_s > first_s { last_s } else { first_s + 1.0 }, pixels)
}

/// The name of the axis, at its end.
pub fn name(right: f64, bottom: f64) -> Markup {
    text("tick", (right, bottom + 28.0), Anchor::End, "time, s")
}

/// A value with its inner and outer interval at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Time, s.
    pub time_s: f64,
    /// The value.
    pub value: f64,
    /// Where it is with about 68 %.
    pub inner: [f64; 2],
    /// Where it is with about 95 %.
    pub outer: [f64; 2],
}

/// Values with their bands; `class` gives the colour.
pub fn spreads(class: &str, time: &Scale, scale: &Scale, run: &[Spread]) -> Markup {
    let at = |of: &dyn Fn(&Spread) -> f64| -> Vec<(f64, f64)> {
        run.iter().map(|spread| (time.at(spread.time_s), scale.at(of(spread)))).collect()
    };
    html! {
        (band(&format!("outer {class}"), &at(&|spread| spread.outer[1]), &at(&|spread| spread.outer[0])))
        (band(&format!("inner {class}"), &at(&|spread| spread.inner[1]), &at(&|spread| spread.inner[0])))
        (path(&format!("value {class}"), &at(&|spread| spread.value)))
    }
}

/// Cuts a series where there is no sample, and where `same` says that one is of another kind than the one before; that one
/// then also ends the run before it, so that no gap shows.
pub fn runs<T: Copy>(series: impl Iterator<Item = Option<T>>, same: impl Fn(&T, &T) -> bool) -> Vec<Vec<T>> {
    let mut runs: Vec<Vec<T>> = Vec::new();
    let mut broken = true;
    for sample in series {
        let Some(sample) = sample else {
            broken = true;
            continue;
        };
        match runs.last_mut() {
            Some(run) if !broken => {
                let goes_on = run.last().is_some_and(|last| same(last, &sample));
                run.push(sample);
                if !goes_on {
                    runs.push(vec![sample]);
                }
            }
            _ => runs.push(vec![sample]),
        }
        broken = false;
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::runs;

    #[test]
    fn a_series_is_cut_where_nothing_is_and_where_it_changes() {
        let series = [None, Some(1), Some(3), None, Some(5), Some(6), Some(8)];
        let cut = runs(series.into_iter(), |one, two| one % 2 == two % 2);
        assert_eq!(cut, [vec![1, 3], vec![5, 6], vec![6, 8]]);
    }
}
