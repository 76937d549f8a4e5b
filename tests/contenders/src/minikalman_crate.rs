//! The crate minikalman. Its buffers are made by macros, so each size is a function of its own.

/// A function `$name` that starts a filter of `$states` states, `$points` sigma points and `$measurements` measurements,
/// and gives its step.
macro_rules! minikalman_filter {
    ($name:ident, $states:literal, $points:literal, $measurements:literal, $drift:literal) => {
        #[doc = concat!("A filter of ", $states, " states and ", $measurements, " measurements.")]
        pub fn $name(scales: &Scales) -> impl FnMut(Option<&[f32; $measurements]>) -> Answer<$states> + use<> {
            impl_buffer_x!(mut state, $states, f32, 0.0);
            impl_buffer_P!(mut covariance, $states, f32, 0.0);
            impl_buffer_Q_direct!(mut process_noise, $states, f32, 0.0);
            impl_buffer_temp_x!(mut predicted, $states, f32, 0.0);
            impl_buffer_sigma_points!(mut points, $states, $points, f32, 0.0);
            impl_buffer_sigma_weights!(mut weights, $points, f32, 0.0);
            impl_buffer_sigma_propagated!(mut propagated, $states, $points, f32, 0.0);
            impl_buffer_temp_sigma_P!(mut scratch, $states, f32, 0.0);
            impl_buffer_z!(mut measured, $measurements, f32, 0.0);
            impl_buffer_R!(mut noise, $measurements, f32, 0.0);
            impl_buffer_y!(mut innovation, $measurements, f32, 0.0);
            impl_buffer_S!(mut innovation_covariance, $measurements, f32, 0.0);
            impl_buffer_K!(mut gain, $states, $measurements, f32, 0.0);
            impl_buffer_temp_S_inv!(mut inverse, $measurements, f32, 0.0);
            impl_buffer_sigma_observed!(mut observed, $measurements, $points, f32, 0.0);
            impl_buffer_cross_covariance!(mut cross, $states, $measurements, f32, 0.0);
            impl_buffer_temp_sigma_P!(mut other_scratch, $states, f32, 0.0);
            let mut filter = UnscentedKalman::new(
                state,
                covariance,
                process_noise,
                predicted,
                points,
                weights,
                propagated,
                scratch,
                ALPHA,
                BETA,
                KAPPA,
            );
            let mut sensors = UnscentedObservation::new(
                measured,
                noise,
                innovation,
                innovation_covariance,
                gain,
                inverse,
                observed,
                cross,
                other_scratch,
            );
            filter.estimate_covariance_mut().make_scalar(scales.start_std * scales.start_std);
            filter.direct_process_noise_mut().make_scalar(scales.process_std * scales.process_std);
            sensors.measurement_noise_covariance_mut().make_scalar(scales.noise_std * scales.noise_std);
            move |measured| {
                filter.predict_nonlinear(|next| {
                    let x: [f32; $states] = from_fn(|row| next.as_matrix().get_at(row, 0));
                    let later = process::<f32, $states, $drift>(|value| value as f32, &x);
                    later.iter().enumerate().for_each(|(row, value)| next.as_matrix_mut().set_at(row, 0, *value));
                });
                if let Some(measured) = measured {
                    let z = sensors.measurement_vector_mut();
                    measured.iter().enumerate().for_each(|(row, value)| z.as_matrix_mut().set_at(row, 0, *value));
                    filter.correct_sigma_point(&mut sensors, |points, observed| {
                        for point in 0..$points {
                            let x: [f32; $states] = from_fn(|row| points[row * $points + point]);
                            let expected: [f32; $measurements] = trial::measurement(&x);
                            for (row, value) in expected.iter().enumerate() {
                                observed[row * $points + point] = *value;
                            }
                        }
                    });
                }
                // It has no way of saying that something is wrong.
                Answer {
                    mean: from_fn(|row| filter.state_vector().as_matrix().get_at(row, 0)),
                    told: false,
                    failed: false,
                }
            }
        }
    };
}

use core::array::from_fn;

use kapvik_firmware::filter::trial::{self, Scales};
use minikalman::prelude::*;
use minikalman::unscented::{UnscentedKalman, UnscentedObservation};
use minikalman::{
    impl_buffer_K, impl_buffer_P, impl_buffer_Q_direct, impl_buffer_R, impl_buffer_S, impl_buffer_cross_covariance,
    impl_buffer_sigma_observed, impl_buffer_sigma_points, impl_buffer_sigma_propagated, impl_buffer_sigma_weights,
    impl_buffer_temp_S_inv, impl_buffer_temp_sigma_P, impl_buffer_temp_x, impl_buffer_x, impl_buffer_y, impl_buffer_z,
};

use crate::contender::{ALPHA, Answer, BETA, KAPPA, process};

minikalman_filter!(six_by_six, 6, 13, 6, false);
minikalman_filter!(twelve_by_eighteen, 12, 25, 18, false);
minikalman_filter!(drifting, 3, 7, 2, true);
