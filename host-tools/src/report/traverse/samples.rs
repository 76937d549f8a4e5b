//! Estimates and truths, thinned to what a picture can show.

use kapvik_firmware::estimator::GAP_US;
use kapvik_firmware::pipeline::FrameEstimate;

use crate::data::truth_file::Truth;

/// The most samples that are kept: two for each pixel of a chart of one wheel.
const MOST: usize = 400;

/// What was estimated at one instant, and what was true.
#[derive(Debug, Clone)]
pub struct Sample {
    /// The estimates.
    pub estimate: FrameEstimate,
    /// The truth, where it is known.
    pub truth: Option<Truth>,
    /// Whether the filters started anew since the sample before: nothing is known of the time between.
    pub after_gap: bool,
}

impl Sample {
    /// Time, s.
    pub fn time_s(&self) -> f64 {
        1e-6 * self.estimate.time_us as f64
    }
}

/// Evenly spaced samples of a drive of any length: every frame, then every second one, every fourth …
#[derive(Debug, Clone)]
pub struct Samples {
    kept: Vec<Sample>,
    last: Option<Sample>,
    stride: u64,
    frames: u64,
    /// A gap since the last sample that is kept.
    gap: bool,
}

impl Default for Samples {
    fn default() -> Self {
        Self { kept: Vec::new(), last: None, stride: 1, frames: 0, gap: false }
    }
}

impl Samples {
    /// Takes the next frame.
    pub fn push(&mut self, estimate: &FrameEstimate, truth: Option<&Truth>) {
        self.gap |= self.last.as_ref().is_some_and(|last| is_gap(last.estimate.time_us, estimate.time_us));
        let sample = Sample { estimate: *estimate, truth: truth.copied(), after_gap: self.gap };
        if self.frames.is_multiple_of(self.stride) {
            self.kept.push(sample.clone());
            self.gap = false;
        }
        self.last = Some(sample);
        self.frames += 1;
        if self.kept.len() > MOST {
            self.thin();
        }
    }

    /// Leaves every second sample out, but not the gap that is before it.
    fn thin(&mut self) {
        let (mut place, mut gap) = (0, false);
        self.kept.retain_mut(|sample| {
            place += 1;
            let stays = place % 2 == 1;
            sample.after_gap |= gap;
            gap = sample.after_gap && !stays;
            stays
        });
        self.gap |= gap;
        self.stride *= 2;
    }

    /// What there is to draw of each sample; nothing also where there is a gap, for no line goes across it.
    pub fn series<T>(&self, of: impl Fn(&Sample) -> Option<T>) -> impl Iterator<Item = Option<T>> {
        self.kept
            .iter()
            .flat_map(move |sample| [sample.after_gap.then_some(None), Some(of(sample))].into_iter().flatten())
    }

    /// The samples, in the order of time.
    pub fn kept(&self) -> &[Sample] {
        &self.kept
    }

    /// That of the last frame, which may not be among those.
    pub fn last(&self) -> Option<&Sample> {
        self.last.as_ref()
    }

    /// First and last time, s.
    pub fn span_s(&self) -> (f64, f64) {
        let first = self.kept.first().map_or(0.0, Sample::time_s);
        (first, self.last.as_ref().map_or(first, Sample::time_s))
    }
}

/// Whether the filters start anew with a frame of the second of these times, µs: after a long gap, or where a clock was set back.
fn is_gap(before_us: u64, time_us: u64) -> bool {
    time_us.checked_sub(before_us).is_none_or(|step_us| step_us > GAP_US)
}

#[cfg(test)]
mod tests {
    use super::*;
    use kapvik_firmware::rover::{PerAxle, PerSide};
    use kapvik_firmware::soil::Refusal;

    /// Samples of frames at these times, µs.
    fn samples(times_us: impl Iterator<Item = u64>) -> Samples {
        let mut samples = Samples::default();
        for time_us in times_us {
            let estimate = FrameEstimate {
                time_us,
                wheels: PerSide::default(),
                bogie_drawbar_pull_n: PerSide::default(),
                wheel_soils: PerSide::both(PerAxle::all(Err(Refusal::NotRolling))),
                soil: Err(Refusal::NotRolling),
            };
            samples.push(&estimate, None);
        }
        samples
    }

    /// However far apart the samples are that are left: 6 s in the last of these drives.
    #[test]
    fn a_series_breaks_at_gaps_alone() {
        let drives = [(50, vec![20]), (390, vec![0, 388]), (5_000, vec![7, 8, 3_001]), (20_000, vec![13_333])];
        for (frames, gaps) in drives {
            let gap_before = |frame: &u64| gaps.iter().filter(|gap| *gap < frame).count() as u64;
            let samples = samples((0..frames).map(|frame| 100_000 * frame + 20_000_000 * gap_before(&frame)));
            let runs: Vec<Option<f64>> = samples.series(|sample| Some(sample.time_s())).collect();
            let breaks = runs.iter().filter(|time_s| time_s.is_none()).count();
            // Two gaps between the same samples are one.
            let expected = gaps.iter().map(|gap| gap / samples.stride).collect::<std::collections::BTreeSet<_>>().len();
            assert_eq!(breaks, expected, "{frames} frames: {runs:?}");
            assert_eq!(runs.len() - breaks, samples.kept().len());
        }
    }

    #[test]
    fn a_long_drive_is_thinned_evenly() {
        let samples = samples((0..10_000).map(|frame| 100_000 * frame));
        assert_eq!(samples.span_s(), (0.0, 999.9), "the last frame, though it is none of those kept");
        let times: Vec<u64> = samples.kept().iter().map(|sample| sample.estimate.time_us).collect();
        assert!((MOST / 2..=MOST).contains(&times.len()), "{}", times.len());
        let step = times[1] - times[0];
        assert!(times.windows(2).all(|pair| pair[1] - pair[0] == step));
    }
}
