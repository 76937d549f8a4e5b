//! Estimates and truths, thinned to what a picture can show.

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
}

impl Default for Samples {
    fn default() -> Self {
        Self { kept: Vec::new(), last: None, stride: 1, frames: 0 }
    }
}

impl Samples {
    /// Takes the next frame.
    pub fn push(&mut self, estimate: &FrameEstimate, truth: Option<&Truth>) {
        let sample = Sample { estimate: *estimate, truth: truth.copied() };
        if self.frames.is_multiple_of(self.stride) {
            self.kept.push(sample.clone());
        }
        self.last = Some(sample);
        self.frames += 1;
        if self.kept.len() > MOST {
            let mut place = 0;
            self.kept.retain(|_| {
                place += 1;
                place % 2 == 1
            });
            self.stride *= 2;
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use kapvik_firmware::rover::{PerAxle, PerSide};
    use kapvik_firmware::soil::Refusal;

    #[test]
    fn a_long_drive_is_thinned_evenly() {
        let mut samples = Samples::default();
        let mut estimate = FrameEstimate {
            time_us: 0,
            wheels: PerSide::default(),
            bogie_drawbar_pull_n: PerSide::default(),
            wheel_soils: PerSide::both(PerAxle::all(Err(Refusal::NotRolling))),
            soil: Err(Refusal::NotRolling),
        };
        for frame in 0..10_000 {
            estimate.time_us = 100_000 * frame;
            samples.push(&estimate, None);
        }
        assert_eq!(samples.span_s(), (0.0, 999.9), "the last frame, though it is none of those kept");
        let times: Vec<u64> = samples.kept().iter().map(|sample| sample.estimate.time_us).collect();
        assert!((MOST / 2..=MOST).contains(&times.len()), "{}", times.len());
        let step = times[1] - times[0];
        assert!(times.windows(2).all(|pair| pair[1] - pair[0] == step));
    }
}
