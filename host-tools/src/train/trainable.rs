//! What the trainers need of a network: outputs, and a loss's way back to the weights.

use kapvik_firmware::network::{OUTPUTS, Words};
use pulp::{Arch, Simd, WithSimd};
use rand::RngExt;

use super::dataset::stream;
use super::example::Example;
use super::lanes::{LANES, Lane, ZERO};
use super::layer::{Layer, Weights};
use super::loss::Loss;

/// Coefficient A of the bipolar sigmoid (equation 13): 2 makes it the hyperbolic tangent. Any other value is the same
/// family of networks with scaled weights.
pub const GRADIENT: f32 = 2.0;

/// A network that can be trained, a block of examples at a time.
pub trait Trainable: Words + Clone + Send + Sync {
    /// Normalised inputs.
    type Input: Send + Sync + Clone;
    /// Inputs and what the neurons put out, example by example in lanes.
    type Block;

    /// A network with all weights zero.
    fn zero() -> Self;
    /// Fan-in of each number that is to be drawn at random, 0 for those that start at zero.
    fn fan_in() -> Self;
    /// Rows and columns of the matrices of numbers that follow each other in [`Words`]: one a layer, an input a row, the
    /// bias the last.
    fn matrices() -> Vec<[usize; 2]>;
    /// Runs it on at most `LANES` examples; lanes without an example hold anything finite.
    fn run_block<S: Simd>(&self, simd: S, examples: &[Example<Self::Input>]) -> Self::Block;
    /// The outputs in a block.
    fn outputs(block: &Self::Block) -> &[Lane; OUTPUTS];
    /// Adds to `gradient` the derivative of the sum over the lanes of `slope` · outputs with respect to every weight.
    fn backward<S: Simd>(&self, simd: S, block: &Self::Block, slope: &[Lane; OUTPUTS], gradient: &mut Self);

    /// The network that flies for these weights, as far as training minds what rounding does to it: slopes are taken there,
    /// while the numbers that are changed stay in single precision, or small steps would be lost (Courbariaux et al. 2015,
    /// "BinaryConnect", has it for weights of one bit).
    fn as_flown(&self) -> Self {
        self.clone()
    }

    /// Takes weights that whole numbers hold coarsely back to where they are held finely enough.
    fn bound_sums(&mut self) {}
}

/// Numbers of a network.
pub fn parameter_count<N: Words>(network: &N) -> usize {
    let mut count = 0;
    network.for_each(&mut |_| count += 1);
    count
}

/// All numbers of a network in order.
pub fn flatten<N: Words>(network: &N) -> Vec<f32> {
    let mut flat = Vec::new();
    network.for_each(&mut |word| flat.push(f32::from_bits(word)));
    flat
}

/// Calls `change` with each number of a network and the value that belongs to it, in order.
pub fn change_each<N: Words, V>(
    network: &mut N,
    values: impl IntoIterator<Item = V>,
    mut change: impl FnMut(&mut f32, V),
) {
    let mut values = values.into_iter();
    network.for_each_mut(&mut |word| {
        if let Some(value) = values.next() {
            let mut number = f32::from_bits(*word);
            change(&mut number, value);
            *word = number.to_bits();
        }
    });
}

/// One list of each example's numbers as lanes; zero where there is no example.
pub fn in_lanes<'a, const N: usize>(lists: impl Iterator<Item = &'a [f32; N]>) -> [Lane; N] {
    let mut lanes = [ZERO; N];
    for (place, list) in lists.enumerate() {
        lanes.iter_mut().zip(list).for_each(|(lane, number)| lane[place] = *number);
    }
    lanes
}

pub(super) fn layer_fan_in<const I: usize, const O: usize>(fan_in: usize) -> Layer<I, O> {
    Layer { weights: Weights([[fan_in as f32; O]; I]), bias: [0.0; O] }
}

/// Sum of the losses of some examples, and their gradient added to `gradient` where there is one.
pub fn sum_of_losses<N: Trainable>(
    network: &N,
    examples: &[Example<N::Input>],
    loss: Loss,
    gradient: Option<&mut N>,
) -> f32 {
    Arch::new().dispatch(Pass { network, examples, loss, gradient })
}

/// Examples to be run with registers as wide as the machine has.
struct Pass<'a, N: Trainable> {
    network: &'a N,
    examples: &'a [Example<N::Input>],
    loss: Loss,
    gradient: Option<&'a mut N>,
}

impl<N: Trainable> WithSimd for Pass<'_, N> {
    type Output = f32;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f32 {
        let Self { network, examples, loss, mut gradient } = self;
        let mut total = 0.0;
        for examples in examples.chunks(LANES) {
            let block = network.run_block(simd, examples);
            let outputs = N::outputs(&block);
            let mut slopes = [ZERO; OUTPUTS];
            for (lane, example) in examples.iter().enumerate() {
                let (error, slope) = loss(&outputs.map(|output| output[lane]), &example.target);
                slopes.iter_mut().zip(slope).for_each(|(lanes, s)| lanes[lane] = s);
                total += error;
            }
            if let Some(gradient) = gradient.as_deref_mut() {
                network.backward(simd, &block, &slopes, gradient);
            }
        }
        total
    }
}

/// The outputs for an example, and the derivative of each with respect to every weight.
pub struct Linearised {
    /// Outputs.
    pub outputs: [f32; OUTPUTS],
    /// Derivatives of each output, in the order of the weights.
    pub jacobian: [Vec<f32>; OUTPUTS],
}

/// Linearises a network about its weights.
pub fn linearised<N: Trainable>(network: &N, example: &Example<N::Input>) -> Linearised {
    Arch::new().dispatch(Linearise { network, example })
}

struct Linearise<'a, N: Trainable> {
    network: &'a N,
    example: &'a Example<N::Input>,
}

impl<N: Trainable> WithSimd for Linearise<'_, N> {
    type Output = Linearised;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let block = self.network.run_block(simd, std::slice::from_ref(self.example));
        let jacobian = std::array::from_fn(|k| {
            let mut slope = [ZERO; OUTPUTS];
            slope[k][0] = 1.0;
            let mut gradient = N::zero();
            self.network.backward(simd, &block, &slope, &mut gradient);
            flatten(&gradient)
        });
        Linearised { outputs: N::outputs(&block).map(|output| output[0]), jacobian }
    }
}

/// A network with uniform random weights of variance 1 / fan-in and zero biases.
pub fn initial<N: Trainable>(seed: u64) -> N {
    let mut random = stream(seed, 0);
    let mut network = N::fan_in();
    let fan_in = flatten(&network);
    change_each(&mut network, fan_in, |weight, fan_in| {
        if fan_in > 0.0 {
            let share: f32 = random.random();
            *weight = (2.0 * share - 1.0) * (3.0 / fan_in).sqrt();
        }
    });
    network
}

/// A network's outputs for some examples.
pub fn outputs_of<N: Trainable>(network: &N, examples: &[Example<N::Input>]) -> Vec<[f32; OUTPUTS]> {
    Arch::new().dispatch(Outputs { network, examples })
}

struct Outputs<'a, N: Trainable> {
    network: &'a N,
    examples: &'a [Example<N::Input>],
}

impl<N: Trainable> WithSimd for Outputs<'_, N> {
    type Output = Vec<[f32; OUTPUTS]>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut all = Vec::with_capacity(self.examples.len());
        for examples in self.examples.chunks(LANES) {
            let block = self.network.run_block(simd, examples);
            all.extend((0..examples.len()).map(|lane| N::outputs(&block).map(|output| output[lane])));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::network::TARGETS;

    use super::*;
    use crate::train::loss::gaussian;
    use crate::train::rounding::tests::wave;
    use crate::train::rover_weights::RoverWeights;
    use crate::train::wheel_weights::WheelWeights;

    fn target(seed: usize) -> [f32; TARGETS] {
        std::array::from_fn(|k| wave(seed * 5 + k))
    }

    /// More than fill a block.
    fn examples<const I: usize>() -> Vec<Example<[f32; I]>> {
        let input = |seed: usize| std::array::from_fn(|k| wave(seed * 100 + k));
        (0..LANES + 5).map(|seed| Example { input: input(seed), target: target(seed) }).collect()
    }

    /// Lanes' outputs, whatever the machine, have the bits of an example by itself in narrow registers.
    fn check_bits<N: Trainable>(examples: &[Example<N::Input>]) {
        let network: N = initial(3);
        let narrow = |examples| Outputs { network: &network, examples }.with_simd(pulp::Scalar::new());
        let alone: Vec<_> = examples.chunks(1).flat_map(narrow).collect();
        let bits = |outputs: Vec<[f32; OUTPUTS]>| outputs.into_iter().map(|o| o.map(f32::to_bits)).collect::<Vec<_>>();
        let alone = bits(alone);
        assert_eq!(bits(outputs_of(&network, examples)), alone);
        assert_eq!(bits(narrow(examples)), alone);
    }

    #[test]
    fn outputs_are_the_same_bits_whatever_the_machine() {
        check_bits::<RoverWeights>(&examples());
        check_bits::<WheelWeights>(&examples());
    }

    fn check_gradient<N: Trainable>(examples: &[Example<N::Input>]) {
        const STEP: f32 = 2e-2;
        let mut network: N = initial(3);
        let mut gradient = N::zero();
        sum_of_losses(&network, examples, gaussian, Some(&mut gradient));
        let (mut scalar, pass) = (N::zero(), &network);
        Pass { network: pass, examples, loss: gaussian, gradient: Some(&mut scalar) }.with_simd(pulp::Scalar::new());
        let gradient = flatten(&gradient);
        assert_eq!(gradient, flatten(&scalar), "other registers, other bits");
        let weights = flatten(&network);
        for place in (0..weights.len()).step_by(29) {
            let mut loss_at = |step: f32| {
                let moved = weights.iter().enumerate().map(|(k, w)| if k == place { w + step } else { *w });
                change_each(&mut network, moved, |weight, value| *weight = value);
                sum_of_losses(&network, examples, gaussian, None)
            };
            let slope = (loss_at(STEP) - loss_at(-STEP)) / (2.0 * STEP);
            assert!(
                (slope - gradient[place]).abs() < 0.01 + 0.01 * slope.abs(),
                "{place}: {slope}, {}",
                gradient[place]
            );
        }
    }

    #[test]
    fn gradients_are_those_of_differences() {
        check_gradient::<RoverWeights>(&examples());
        check_gradient::<WheelWeights>(&examples());
    }

    #[test]
    fn matrices_hold_every_number_once() {
        let numbers = |matrices: Vec<[usize; 2]>| matrices.iter().map(|[rows, columns]| rows * columns).sum::<usize>();
        assert_eq!(numbers(RoverWeights::matrices()), parameter_count(&RoverWeights::ZERO));
        assert_eq!(numbers(WheelWeights::matrices()), parameter_count(&WheelWeights::ZERO));
    }
}
