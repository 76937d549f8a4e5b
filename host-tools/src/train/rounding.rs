//! Rounding of a trained layer to the whole numbers of 16 bits that fly.

use kapvik_firmware::network::fixed_point::{ACTIVATION_BITS, FixedLayer, MAX_WEIGHT_BITS, Pair, SUM_BITS};

use super::layer::Layer;

/// What the full range of a network's inputs stands for.
pub const INPUT_RANGE: f32 = (1 << (ACTIVATION_BITS - SUM_BITS)) as f32;

/// The full range of inputs of 16 bits.
const FULL_RANGE: f64 = 32_768.0;

/// What the numbers of a layer stand for beside single precision.
pub struct Scales<G> {
    /// What the full range of the inputs, 32 768, stands for.
    pub input_range: f32,
    /// Multiplies each sum.
    pub sums: G,
    /// Fraction bits that the sums are cut to on their way to an activation, if they are: half of the last is added.
    pub cut_to: Option<u32>,
}

impl<G: Fn(usize) -> f32> Scales<G> {
    /// The layer with as many fraction bits as its weights and sums leave room for. Inputs and sums that the flown layer has
    /// beyond those of `layer`, because it takes them by fours, are zero.
    ///
    /// A network that has diverged saturates; [`FixedLayer::cannot_overflow`] tells then that it cannot fly.
    pub fn round<const I: usize, const O: usize, const H: usize, const T: usize>(
        &self,
        layer: &Layer<I, O>,
    ) -> FixedLayer<H, T> {
        let greatest = self.greatest_weight(layer);
        let held = |bits: &u32| libm::exp2(f64::from(*bits)) * greatest <= f64::from(i16::MAX);
        let mut finest_first =
            (0..=MAX_WEIGHT_BITS).rev().filter(held).map(|bits| self.with_fraction_bits(layer, bits));
        let fits = |(fixed, saturated): &(FixedLayer<H, T>, bool)| !saturated && fixed.cannot_overflow();
        finest_first.find(fits).unwrap_or_else(|| self.with_fraction_bits(layer, 0)).0
    }

    /// The layer that a rounded one stands for.
    pub fn read<const I: usize, const O: usize, const H: usize, const T: usize>(
        &self,
        fixed: &FixedLayer<H, T>,
    ) -> Layer<I, O> {
        let unit = libm::exp2(f64::from(fixed.fraction_bits));
        let half = self.half(unit);
        let mut layer = Layer::ZERO;
        for (sum, bias) in layer.bias.iter_mut().enumerate() {
            let scale = f64::from((self.sums)(sum));
            let whole = f64::from(fixed.bias[sum / 4][sum % 4]);
            *bias = ((whole - half) / (unit * FULL_RANGE) / scale) as f32;
        }
        for (input, row) in layer.weights.0.iter_mut().enumerate() {
            for (sum, weight) in row.iter_mut().enumerate() {
                let pair = fixed.weights[sum / 4][input / 4][input % 4 / 2][sum % 4];
                let scale = f64::from(self.input_range * (self.sums)(sum));
                *weight = (f64::from(pair.halves()[input % 2]) / unit / scale) as f32;
            }
        }
        layer
    }

    /// Takes the weights of each sum that could be too great for so many fraction bits, all by the same factor, back to where it
    /// cannot.
    pub fn bound<const I: usize, const O: usize>(&self, layer: &mut Layer<I, O>, fraction_bits: u32) {
        // Of sums of 32 bits; the rest is for what rounding adds.
        let greatest = 0.995 * libm::exp2f(16.0 - fraction_bits as f32);
        for sum in 0..O {
            let scale = (self.sums)(sum);
            let mut total = layer.bias[sum].abs() * scale;
            for row in &layer.weights.0 {
                total += row[sum].abs() * scale * self.input_range;
            }
            if total > greatest {
                let share = greatest / total;
                layer.bias[sum] *= share;
                layer.weights.0.iter_mut().for_each(|row| row[sum] *= share);
            }
        }
    }

    /// The greatest weight as it flies, before it is a whole number.
    fn greatest_weight<const I: usize, const O: usize>(&self, layer: &Layer<I, O>) -> f64 {
        let scaled =
            |(sum, weight): (usize, &f32)| f64::from(self.input_range * (self.sums)(sum)) * f64::from(weight.abs());
        layer.weights.0.iter().flat_map(|row| row.iter().enumerate().map(scaled)).fold(0.0, f64::max)
    }

    /// What is added to biases, so that sums are rounded on their way to an activation.
    fn half(&self, unit: f64) -> f64 {
        self.cut_to.map_or(0.0, |bits| 0.5 * unit * FULL_RANGE * libm::exp2(-f64::from(bits)))
    }

    /// The layer with so many fraction bits, and whether a number of it did not fit.
    fn with_fraction_bits<const I: usize, const O: usize, const H: usize, const T: usize>(
        &self,
        layer: &Layer<I, O>,
        fraction_bits: u32,
    ) -> (FixedLayer<H, T>, bool) {
        let unit = libm::exp2(f64::from(fraction_bits));
        let mut saturated = false;
        let mut whole = |number: f64, greatest: f64| {
            // What is no number saturates as well: as a zero it would pass for a weight.
            let number = if number.is_nan() { f64::INFINITY } else { number };
            saturated |= number.abs() > greatest;
            number.round().clamp(-greatest, greatest) as i32
        };
        let mut weight = |input: usize, sum: usize| {
            let weight = layer.weights.0.get(input).and_then(|row| row.get(sum)).copied().unwrap_or(0.0);
            let scale = self.input_range * (self.sums)(sum);
            whole(f64::from(weight) * f64::from(scale) * unit, f64::from(i16::MAX)) as i16
        };
        let weights = std::array::from_fn(|tile| {
            std::array::from_fn(|quad| {
                std::array::from_fn(|pair| {
                    let input = 4 * quad + 2 * pair;
                    std::array::from_fn(|neuron| {
                        let sum = 4 * tile + neuron;
                        Pair::new(weight(input, sum), weight(input + 1, sum))
                    })
                })
            })
        });
        let half = self.half(unit);
        let bias = std::array::from_fn(|tile| {
            std::array::from_fn(|neuron| {
                let sum = 4 * tile + neuron;
                let bias = layer.bias.get(sum).copied().unwrap_or(0.0) * (self.sums)(sum);
                whole(f64::from(bias) * unit * FULL_RANGE + half, f64::from(i32::MAX))
            })
        });
        (FixedLayer { weights, bias, fraction_bits }, saturated)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use kapvik_firmware::network::OUTPUTS;
    use kapvik_firmware::network::fixed_point::{ACTIVATION_BITS, rounded};

    use super::*;
    use crate::train::example::Example;
    use crate::train::trainable::{Trainable, outputs_of};

    /// Of inputs between −2 and 2, the flown network makes nearly what the trained one does. What is rounded adds up like noise,
    /// the more the wider the layers are.
    pub fn assert_alike<N: Trainable<Input = [f32; I]>, const I: usize>(
        weights: &N,
        flown: impl Fn(&[f32; I]) -> [f32; OUTPUTS],
    ) {
        let differences: Vec<f32> = (0..200)
            .flat_map(|seed| {
                let input = std::array::from_fn(|k| 2.0 * wave(seed * 100 + k));
                let trained = outputs_of(weights, &[Example { input, target: [0.0; 3] }])[0];
                flown(&input).into_iter().zip(trained).map(|(flown, trained)| flown - trained)
            })
            .collect();
        let root_mean_square = (differences.iter().map(|d| d * d).sum::<f32>() / differences.len() as f32).sqrt();
        let most = differences.iter().fold(0.0_f32, |most, d| most.max(d.abs()));
        println!("flown less trained: {root_mean_square:.1e} RMS, at most {most:.1e}");
        assert!(root_mean_square < 1e-3, "{root_mean_square}");
        assert!(most < 5.0 * root_mean_square, "{most}, {root_mean_square}");
    }

    /// Numbers without a pattern, −1 … 1.
    pub fn wave(seed: usize) -> f32 {
        libm::sinf(2.399 * seed as f32)
    }

    fn layer(scale: f32) -> Layer<5, 6> {
        let mut layer = Layer::ZERO;
        layer.weights.0.as_flattened_mut().iter_mut().enumerate().for_each(|(k, w)| *w = scale * wave(k));
        layer.bias.iter_mut().enumerate().for_each(|(k, b)| *b = scale * wave(100 + k));
        layer
    }

    fn rounded_plainly(layer: &Layer<5, 6>) -> FixedLayer<2, 2> {
        Scales { input_range: 1.0, sums: |_| 1.0, cut_to: None }.round(layer)
    }

    /// Two weights of full size and a bias of full size are more than 32 bits.
    #[test]
    fn what_is_no_number_cannot_fly() {
        let mut layer = layer(1.0);
        layer.bias[2] = f32::NAN;
        layer.weights.0[3][2] = f32::NAN;
        assert!(!rounded_plainly(&layer).cannot_overflow());
    }

    #[test]
    fn sums_are_those_of_the_layer() {
        let input = [0.5, -0.25, 0.125, -0.9375, 0.75];
        let whole = rounded(&input, ACTIVATION_BITS);
        for scale in [1e-3, 0.1, 1.0, 30.0, 3000.0] {
            let layer = layer(scale);
            let fixed = rounded_plainly(&layer);
            assert!(fixed.cannot_overflow());
            let sums: [f32; 8] = fixed.outputs(&whole);
            let unit = 0.5_f32.powi(fixed.fraction_bits as i32);
            for (place, (sum, bias)) in sums.iter().zip(layer.bias).enumerate() {
                let exact = bias + layer.weights.0.iter().zip(input).map(|(row, x)| row[place] * x).sum::<f32>();
                assert!((sum - exact).abs() <= 3.0 * unit + 1e-6 * scale, "{scale}: {sum}, {exact}");
            }
            assert_eq!(sums[6..], [0.0; 2], "sums that the layer does not have");
            assert!(unit < 2e-4 * scale.max(0.2), "{scale}: weights are multiples of {unit}");
        }
    }

    #[test]
    fn what_has_diverged_cannot_fly() {
        let fixed = rounded_plainly(&layer(1e9));
        assert!(!fixed.cannot_overflow());
    }
}
