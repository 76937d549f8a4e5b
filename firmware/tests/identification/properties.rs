//! Whatever goes in, nothing panics and nothing that is not a number comes out.

use std::sync::atomic::{AtomicU32, Ordering};

use kapvik_firmware::identification::ding::{DingBounds, ding};
use kapvik_firmware::identification::iagnemma::{IagnemmaAssumptions, iagnemma};
use kapvik_firmware::identification::{Assumed, Identified, Observation, Refusal};
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::WheelState;
use proptest::prelude::*;

use super::made::NOISE;
use super::mostly::mostly;

/// Of a wheel that drives, or of anything; with a slip and a sinkage at the edge of what can be at times.
fn any_observation() -> impl Strategy<Value = Observation<f64>> {
    let slip = mostly(prop_oneof![30 => 0.05..0.9, 1 => -1.0..=1.0, 1 => Just(0.0), 1 => Just(1.0)]);
    let edges = prop_oneof![Just(0.0), Just(0.075), 0.0..1e-9];
    let sinkage = prop::option::weighted(0.98, mostly(prop_oneof![30 => 0.005..0.04, 1 => edges]));
    (mostly(-10.0..20.0), mostly(20.0..120.0), mostly(0.3..4.0), slip, sinkage).prop_map(
        |(drawbar_pull_n, load_n, torque_nm, slip, sinkage_m)| Observation {
            state: WheelState { drawbar_pull_n, load_n, torque_nm, slip, sinkage_m },
            noise: NOISE,
        },
    )
}

/// Values are numbers, and so are standard deviations, which are not negative.
fn is_sound<S: Scalar>(soil: &Identified<S>) -> bool {
    [soil.cohesion_pa, soil.friction_angle_rad, soil.shear_modulus_m]
        .iter()
        .all(|told| told.value.is_finite() && told.std.is_none_or(|std| std.is_finite() && std >= S::zero()))
        && soil.condition_number >= S::one()
}

fn assumed<S: Scalar>(cohesion_pa: Option<f64>) -> IagnemmaAssumptions<S> {
    let known = |value: f64| Assumed { value: S::constant(value), std: S::constant(0.1 * value) };
    IagnemmaAssumptions { shear_modulus_m: known(0.0114), cohesion_pa: cohesion_pa.map(known) }
}

/// How many answers `ding` and `iagnemma` gave, in double and in single precision.
static ANSWERS: [AtomicU32; 4] = [const { AtomicU32::new(0) }; 4];
/// Of a thousand cases; a hundred are expected of whichever gives the fewest.
const LEAST_ANSWERS: u32 = 70;

/// An answer is of numbers, and is counted.
fn check<S: Scalar>(answer: &Result<Identified<S>, Refusal>, answers: &AtomicU32) -> Result<(), TestCaseError> {
    if let Ok(told) = answer {
        prop_assert!(is_sound(told), "{told:?}");
        answers.fetch_add(1, Ordering::Relaxed);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    fn answers_are_of_numbers(wheels in prop::collection::vec(any_observation(), 0..8), cohesion_pa in prop::option::of(0.0..1e4)) {
        let wheel = Wheel { radius_m: 0.075, width_m: 0.070 };
        for bounds in [DingBounds::usual(), DingBounds::usual().with_any_strength()] {
            check(&ding(&wheel, &wheels, &bounds), &ANSWERS[0])?;
        }
        check(&iagnemma(&wheel, &wheels, &assumed(cohesion_pa)), &ANSWERS[1])?;
        let wheel = wheel.map(|length| length as f32);
        let wheels: Vec<_> = wheels.iter().map(super::made::single).collect();
        check(&ding(&wheel, &wheels, &DingBounds::usual()), &ANSWERS[2])?;
        check(&iagnemma(&wheel, &wheels, &assumed(cohesion_pa)), &ANSWERS[3])?;
    }
}

#[test]
fn an_answer_is_of_numbers() {
    answers_are_of_numbers();
    println!("answers of a thousand cases: {ANSWERS:?}");
    assert!(ANSWERS.iter().all(|answers| answers.load(Ordering::Relaxed) >= LEAST_ANSWERS), "{ANSWERS:?}");
}
