//! The residual loop: what a model leaves over of measured data, traced to an effect that it lacks.

pub mod document;
