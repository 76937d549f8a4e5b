//! Numbers that are mostly as they should be, so that what is made of them gets beyond the checks of its input, and at times anything.

use proptest::num;
use proptest::prelude::*;
use proptest::sample::select;

/// Anything; often what arithmetic goes wrong at, in either precision.
fn wild() -> impl Strategy<Value = f64> {
    let edges = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN_POSITIVE];
    let single = [f32::MAX, f32::MIN_POSITIVE, 1e-45].map(f64::from);
    prop_oneof![num::f64::ANY, -2.0..2.0, 0.0..1e-3, -1e6..1e6, select([&edges[..], &single[..]].concat())]
}

/// One of these nine times of ten.
pub fn mostly(valid: impl Strategy<Value = f64>) -> impl Strategy<Value = f64> {
    prop_oneof![9 => valid, 1 => wild()]
}
