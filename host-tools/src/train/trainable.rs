//! What the trainers need of a network: outputs, and a loss's way back to the weights.

use kapvik_firmware::network::{
    Layer, Numbers, OUTPUTS, ROVER_HEAD_INPUTS, ROVER_HIDDEN, RoverActivations, RoverNetwork, Weights,
    WheelActivations, WheelNetwork,
};

use rand::RngExt;

use super::dataset::stream;
use super::example::{RoverInput, WheelInput};

/// Coefficient A of the bipolar sigmoid (equation 13): 2 makes it the hyperbolic tangent. Any other value is the same
/// family of networks with scaled weights.
pub const GRADIENT: f32 = 2.0;

/// A network that can be trained.
pub trait Trainable: Numbers + Clone + Send + Sync {
    /// Normalised inputs.
    type Input: Send + Sync + Clone;
    /// What the neurons put out.
    type Activations;

    /// A network with all weights zero.
    fn zero() -> Self;
    /// Fan-in of each number that is to be drawn at random, 0 for those that start at zero.
    fn fan_in() -> Self;
    /// Runs the network.
    fn run(&self, input: &Self::Input) -> Self::Activations;
    /// The outputs among the activations.
    fn outputs(activations: &Self::Activations) -> &[f32; OUTPUTS];
    /// Adds to `gradient` the derivative of `slope` · outputs with respect to every weight.
    fn backward(
        &self,
        input: &Self::Input,
        activations: &Self::Activations,
        slope: &[f32; OUTPUTS],
        gradient: &mut Self,
    );
}

/// Numbers of a network.
pub fn parameter_count<N: Numbers>(network: &N) -> usize {
    let mut count = 0;
    network.for_each(&mut |_| count += 1);
    count
}

/// All numbers of a network in order.
pub fn flatten<N: Numbers>(network: &N) -> Vec<f32> {
    let mut flat = Vec::new();
    network.for_each(&mut |number| flat.push(number));
    flat
}

/// Calls `change` with each number of a network and the value that belongs to it, in order.
pub fn change_each<N: Numbers, V>(
    network: &mut N,
    values: impl IntoIterator<Item = V>,
    mut change: impl FnMut(&mut f32, V),
) {
    let mut values = values.into_iter();
    network.for_each_mut(&mut |number| {
        if let Some(value) = values.next() {
            change(number, value);
        }
    });
}

/// The slope before the activation, from the slope behind it.
fn through_activation<const N: usize>(mut slope: [f32; N], output: &[f32; N]) -> [f32; N] {
    for (s, y) in slope.iter_mut().zip(output) {
        *s *= 0.5 * GRADIENT * (1.0 - y * y);
    }
    slope
}

fn through_weights<const I: usize, const O: usize>(input: &[f32; I], slope: &[f32; O], gradient: &mut Weights<I, O>) {
    for (x, row) in input.iter().zip(&mut gradient.0) {
        for (g, s) in row.iter_mut().zip(slope) {
            *g += x * s;
        }
    }
}

fn input_slope<const I: usize, const O: usize>(weights: &Weights<I, O>, slope: &[f32; O]) -> [f32; I] {
    let mut back = [0.0; I];
    for (b, row) in back.iter_mut().zip(&weights.0) {
        // Four partial sums, so that the compiler may keep them in one vector register.
        let mut sums = [0.0_f32; 4];
        for (ws, ss) in row.chunks(4).zip(slope.chunks(4)) {
            for ((sum, w), s) in sums.iter_mut().zip(ws).zip(ss) {
                *sum += w * s;
            }
        }
        *b = (sums[0] + sums[2]) + (sums[1] + sums[3]);
    }
    back
}

fn through_layer<const I: usize, const O: usize>(
    layer: &Layer<I, O>,
    input: &[f32; I],
    slope: &[f32; O],
    gradient: &mut Layer<I, O>,
) -> [f32; I] {
    through_first_layer(input, slope, gradient);
    input_slope(&layer.weights, slope)
}

/// The same where nothing lies before the layer but inputs.
fn through_first_layer<const I: usize, const O: usize>(input: &[f32; I], slope: &[f32; O], gradient: &mut Layer<I, O>) {
    through_weights(input, slope, &mut gradient.weights);
    gradient.bias.iter_mut().zip(slope).for_each(|(g, s)| *g += s);
}

fn layer_fan_in<const I: usize, const O: usize>(fan_in: usize) -> Layer<I, O> {
    Layer { weights: Weights([[fan_in as f32; O]; I]), bias: [0.0; O] }
}

impl Trainable for WheelNetwork {
    type Input = WheelInput;
    type Activations = WheelActivations;

    fn zero() -> Self {
        Self::ZERO
    }
    fn fan_in() -> Self {
        use kapvik_firmware::network::{WHEEL_HIDDEN, WHEEL_INPUTS};
        Self {
            first: layer_fan_in(WHEEL_INPUTS),
            second: layer_fan_in(WHEEL_HIDDEN),
            output: layer_fan_in(WHEEL_HIDDEN),
        }
    }
    fn run(&self, input: &Self::Input) -> Self::Activations {
        WheelNetwork::run(self, input, GRADIENT)
    }
    fn outputs(activations: &Self::Activations) -> &[f32; OUTPUTS] {
        &activations.output
    }
    fn backward(&self, input: &WheelInput, run: &WheelActivations, slope: &[f32; OUTPUTS], gradient: &mut Self) {
        let slope = through_layer(&self.output, &run.second, slope, &mut gradient.output);
        let slope = through_activation(slope, &run.second);
        let slope = through_layer(&self.second, &run.first, &slope, &mut gradient.second);
        let slope = through_activation(slope, &run.first);
        through_first_layer(input, &slope, &mut gradient.first);
    }
}

impl Trainable for RoverNetwork {
    type Input = RoverInput;
    type Activations = RoverActivations;

    fn zero() -> Self {
        Self::ZERO
    }
    fn fan_in() -> Self {
        use kapvik_firmware::network::{ROVER_CONTEXT, ROVER_FIRST_HEAD, ROVER_SECOND_HEAD, WHEEL_FEATURES};
        let wheel = ROVER_CONTEXT + WHEEL_FEATURES;
        Self {
            context: layer_fan_in(wheel),
            wheel: Weights([[wheel as f32; ROVER_HIDDEN]; WHEEL_FEATURES]),
            first: layer_fan_in(ROVER_HEAD_INPUTS),
            second: layer_fan_in(ROVER_FIRST_HEAD),
            output: layer_fan_in(ROVER_SECOND_HEAD),
        }
    }
    fn run(&self, input: &Self::Input) -> Self::Activations {
        RoverNetwork::run(self, &input.context, input.wheels.iter().copied(), GRADIENT)
    }
    fn outputs(activations: &Self::Activations) -> &[f32; OUTPUTS] {
        &activations.output
    }
    fn backward(&self, input: &RoverInput, run: &RoverActivations, slope: &[f32; OUTPUTS], gradient: &mut Self) {
        let slope = through_layer(&self.output, &run.second, slope, &mut gradient.output);
        let slope = through_activation(slope, &run.second);
        let slope = through_layer(&self.second, &run.first, &slope, &mut gradient.second);
        let slope = through_activation(slope, &run.first);
        let pool_slope = through_layer(&self.first, &run.pool, &slope, &mut gradient.first);
        let share = 1.0 / run.wheels.len() as f32;
        let mut context_slope = [0.0; ROVER_HIDDEN];
        for (features, hidden) in input.wheels.iter().zip(&run.wheels) {
            let mut slope = [0.0; ROVER_HIDDEN];
            for (k, s) in slope.iter_mut().enumerate() {
                // The variance's slope by way of the mean vanishes, since deviations add up to zero.
                *s = share * (pool_slope[k] + 2.0 * pool_slope[ROVER_HIDDEN + k] * (hidden[k] - run.pool[k]));
            }
            let slope = through_activation(slope, hidden);
            through_weights(features, &slope, &mut gradient.wheel);
            context_slope.iter_mut().zip(slope).for_each(|(sum, s)| *sum += s);
        }
        through_first_layer(&input.context, &context_slope, &mut gradient.context);
    }
}

/// Derivative of each output with respect to every weight.
pub fn output_jacobian<N: Trainable>(network: &N, input: &N::Input, run: &N::Activations) -> [Vec<f32>; OUTPUTS] {
    std::array::from_fn(|k| {
        let mut slope = [0.0; OUTPUTS];
        slope[k] = 1.0;
        let mut gradient = N::zero();
        network.backward(input, run, &slope, &mut gradient);
        flatten(&gradient)
    })
}

/// A network with uniform random weights of variance 1 / fan-in and zero biases.
pub fn initial<N: Trainable>(seed: u64) -> N {
    let mut random = stream(seed, 0);
    let mut network = N::fan_in();
    network.for_each_mut(&mut |weight| {
        if *weight > 0.0 {
            let share: f32 = random.random();
            *weight = (2.0 * share - 1.0) * (3.0 / *weight).sqrt();
        }
    });
    network
}
