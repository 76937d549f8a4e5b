//! The filter of this project.

use kapvik_firmware::filter::trial::{self, Scales};
use kapvik_firmware::filter::{Fate, Fusion, Gate, Gaussian, Prediction, SigmaPointFilter};

use crate::contender::{Answer, Contender};

/// What every standard deviation is multiplied by when the gate rejects most measurements of a step.
const WIDENING: f32 = 10.0;

/// With its gate, or with the gate open.
pub struct Ours<const N: usize, const DRIFT: bool, const GATED: bool> {
    filter: SigmaPointFilter<f32, N>,
    scales: Scales,
}

impl<const N: usize, const M: usize, const DRIFT: bool, const GATED: bool> Contender<N, M> for Ours<N, DRIFT, GATED> {
    fn start(scales: &Scales) -> Self {
        let std = [scales.start_std; N];
        let start = Gaussian::independent([0.0; N], std).expect("numbers");
        Self { filter: SigmaPointFilter::new(start, std).expect("numbers"), scales: *scales }
    }

    #[inline]
    fn step(&mut self, measured: Option<&[f32; M]>) -> Answer<N> {
        let noise = [self.scales.process_std; N];
        let prediction =
            if DRIFT { self.filter.random_walk(&noise) } else { self.filter.predict(trial::process, &noise) };
        let mut told = prediction != Prediction::Done;
        let mut failed = prediction == Prediction::Reset;
        if let Some(measured) = measured {
            let noise = [self.scales.noise_std; M];
            let gate = if GATED { Gate::one_in_a_thousand() } else { Gate::Open };
            let innovation = self.filter.update(trial::measurement, &measured.map(Some), &noise, gate);
            failed |= innovation.fusion == Fusion::Reset;
            let rejected = innovation.residuals.iter().filter(|residual| residual.fate == Fate::Rejected).count();
            if 2 * rejected > M {
                // It cannot be that most sensors are wrong at once: the filter is too sure.
                failed |= self.filter.widen(WIDENING) == Prediction::Reset;
            }
            told |= innovation.residuals.iter().any(|residual| residual.fate != Fate::Used);
        }
        Answer { mean: *self.filter.estimate().mean(), told: told || failed, failed }
    }
}
