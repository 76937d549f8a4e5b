//! The residual loop: what a model leaves over of measured data, traced to an effect that it lacks, and how sure that is.

pub mod document;
pub mod fit;
