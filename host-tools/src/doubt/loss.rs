//! What the network is trained by: how unlikely the errors are under the standard deviations that it makes.
//!
//! Twice the negative log-likelihood of normal errors with the stated correlations, torque with slip, and contact angle with load and
//! pull; half as much again of each of these five by itself, so that it is honest, too, where a correlation is not; and the same of
//! the sum of the bogie's pulls. What does not depend on the network is left out.

use kapvik_firmware::estimator::doubt::{GREATEST_OUTPUT, OUTPUTS, times_stated};

use super::rows::{Known, Precision};

/// How much the likelihood of each quantity of a wheel by itself counts, beside that of all together.
const ALONE: f32 = 0.5;

/// The loss of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loss {
    /// The loss.
    pub value: f32,
    /// Its slope against each output.
    pub slope: [f32; OUTPUTS],
}

/// The loss of a row of which this is known, where the network puts out these.
pub fn loss(outputs: &[f32; OUTPUTS], known: &Known) -> Loss {
    let times = outputs.map(times_stated);
    let mut errors = known.errors;
    errors.iter_mut().zip(times).for_each(|(error, times)| *error /= times);
    let mut loss = Loss { value: 0.0, slope: [0.0; OUTPUTS] };
    let (of_wheels, of_bogie) = errors.as_chunks();
    let (slopes, bogie_slope) = loss.slope.as_chunks_mut();
    for ((errors, slope), precision) in of_wheels.iter().zip(slopes).zip(known.wheels.as_array()) {
        loss.value += add_wheel(errors, precision, slope);
    }
    for (error, slope) in of_bogie.iter().zip(bogie_slope) {
        loss.value += square(&[*error], &[[1.0]], std::array::from_mut(slope));
    }
    // Each output adds to the logarithm of a determinant.
    for (place, (slope, times)) in loss.slope.iter_mut().zip(times).enumerate() {
        let counts = if place + 1 < OUTPUTS { 2.0 * (1.0 + ALONE) } else { 2.0 };
        loss.value += counts * libm::logf(times);
        *slope += counts;
    }
    for (slope, (output, times)) in loss.slope.iter_mut().zip(outputs.iter().zip(times)) {
        *slope *= by_output(*output, times);
    }
    loss
}

/// The slope of the logarithm of what a standard deviation is multiplied by against its output: straight between whole octaves, and
/// nothing beyond the bounds, where an output changes nothing.
fn by_output(output: f32, times: f32) -> f32 {
    if output.abs() > GREATEST_OUTPUT { 0.0 } else { libm::exp2f(libm::floorf(output)) / times }
}

/// The squares of a wheel's errors, in units of what is stated and doubted, added with their slopes.
fn add_wheel(errors: &[f32; 5], precision: &Precision, slope: &mut [f32; 5]) -> f32 {
    let [torque, slip, angle, load, pull] = *errors;
    let [of_filter_1 @ .., _, _, _] = slope;
    let filter_1 = square(&[torque, slip], &precision.torque_slip, of_filter_1);
    let [_, _, of_filter_2 @ ..] = slope;
    let filter_2 = square(&[angle, load, pull], &precision.contact, of_filter_2);
    let mut alone = 0.0;
    for (error, slope) in errors.iter().zip(slope) {
        alone += ALONE * error * error;
        *slope -= 2.0 * ALONE * error * error;
    }
    filter_1 + filter_2 + alone
}

/// The square of errors under a precision; its slope against the logarithms of their units is added to `slope`.
fn square<const N: usize>(errors: &[f32; N], precision: &[[f32; N]; N], slope: &mut [f32; N]) -> f32 {
    let mut sum = 0.0;
    for ((error, line), slope) in errors.iter().zip(precision).zip(slope) {
        let weighted: f32 = line.iter().zip(errors).map(|(entry, other)| entry * other).sum();
        sum += error * weighted;
        *slope -= 2.0 * error * weighted;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::doubt::rows::tests::correlated;

    fn known() -> Known {
        let errors = std::array::from_fn(|place| 2.0 * libm::sinf(2.399 * place as f32));
        Known { errors, wheels: correlated() }
    }

    #[test]
    fn slopes_are_those_of_differences() {
        const STEP: f32 = 5e-3;
        // None is near a whole octave, where the slope jumps.
        let outputs: [f32; OUTPUTS] = std::array::from_fn(|place| 1.4 * libm::sinf(1.7 * place as f32 + 0.2));
        let slope = loss(&outputs, &known()).slope;
        for (place, slope) in slope.into_iter().enumerate() {
            let at = |step: f32| {
                let mut moved = outputs;
                moved[place] += step;
                f64::from(loss(&moved, &known()).value)
            };
            let expected = (at(STEP) - at(-STEP)) / f64::from(2.0 * STEP);
            let slope = f64::from(slope);
            assert!((slope - expected).abs() < 0.01 + 0.002 * expected.abs(), "{place}: {slope}, {expected}");
        }
    }

    #[test]
    fn beyond_its_bounds_an_output_changes_nothing() {
        let [at, beyond] = [1.0, 1.5].map(|times| loss(&[-times * GREATEST_OUTPUT; OUTPUTS], &known()));
        assert_eq!(at.value, beyond.value);
        assert_eq!(beyond.slope, [0.0; OUTPUTS]);
    }
}
