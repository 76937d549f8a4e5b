//! Training of the networks on the ground: stated priors, wheel–soil theory, sensor noise, three trainers, one table.

pub mod adam;
pub mod example;
pub mod loss;
pub mod observe;
pub mod prior;
pub mod scene;
pub mod trainable;
