//! The networks that were trained on the ground, frozen into the image by the build script.
#![allow(clippy::excessive_precision, clippy::unreadable_literal, clippy::approx_constant)] // generated numbers

use crate::network::fixed_point::{FixedLayer, Pair};
use crate::network::*;

include!(concat!(env!("OUT_DIR"), "/frozen.rs"));
