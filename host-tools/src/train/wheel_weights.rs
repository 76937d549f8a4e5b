//! The per-wheel network while it is trained: the same network as the flown one, in single precision.

use kapvik_firmware::network::fixed_point::SUM_BITS;
use kapvik_firmware::network::{OUTPUTS, WHEEL_HIDDEN, WHEEL_INPUTS, WheelNetwork};
use kapvik_firmware::words;

use super::layer::Layer;
use super::rounding::{INPUT_RANGE, Scales};
use super::trainable::GRADIENT;

/// Weights of [`kapvik_firmware::network::WheelNetwork`] before they are rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelWeights {
    /// First hidden layer.
    pub first: Layer<WHEEL_INPUTS, WHEEL_HIDDEN>,
    /// Second hidden layer.
    pub second: Layer<WHEEL_HIDDEN, WHEEL_HIDDEN>,
    /// Linear output: means, then log-variances.
    pub output: Layer<WHEEL_HIDDEN, OUTPUTS>,
}
words!(WheelWeights: first, second, output);

impl WheelWeights {
    /// All weights zero.
    pub const ZERO: Self = Self { first: Layer::ZERO, second: Layer::ZERO, output: Layer::ZERO };

    /// The network as it flies: rounded to whole numbers. Flown neurons know no coefficient A.
    pub fn rounded(&self) -> WheelNetwork {
        let (sums, cut_to) = (|_| 0.5 * GRADIENT, Some(SUM_BITS));
        WheelNetwork {
            first: Scales { input_range: INPUT_RANGE, sums, cut_to }.round(&self.first),
            second: Scales { input_range: 1.0, sums, cut_to }.round(&self.second),
            output: Scales { input_range: 1.0, sums: |_| 1.0, cut_to: None }.round(&self.output),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::train::rounding::tests::assert_alike;
    use crate::train::trainable::initial;

    #[test]
    fn the_rounded_network_is_nearly_the_same() {
        let weights: WheelWeights = initial(3);
        let flown = weights.rounded();
        assert!(flown.cannot_overflow());
        assert_alike(&weights, |input| flown.run(input));
    }
}
