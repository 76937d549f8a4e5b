//! Arithmetic on columns of a dozen numbers.

/// Adds `factor` times some numbers. The matrix library's own allows for numbers that do not lie side by side, and takes them
/// one by one.
pub(super) fn add_times(sum: &mut [f64], factor: f64, numbers: &[f64]) {
    for (sum, number) in sum.iter_mut().zip(numbers) {
        *sum += factor * number;
    }
}
