//! Diagnosis of a model by measured data: what it lacks, and how sure that is.

pub mod fit;
