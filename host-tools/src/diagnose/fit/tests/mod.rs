//! The fit engine against closed forms and against Gaussian densities computed from dense covariance matrices.

mod bounds;
mod dense;
mod errors_in_variables;
mod gain_chance;
mod held_out;
mod linear;
mod memory;
mod missing;
mod offsets;
mod robust;
mod starts;
mod toy;
mod valley;
mod wheel;
