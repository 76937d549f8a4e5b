//! Whatever goes in, nothing panics and nothing that is not a number comes out.

use kapvik_firmware::identification::ding::{DingBounds, ding};
use kapvik_firmware::identification::iagnemma::{IagnemmaAssumptions, iagnemma};
use kapvik_firmware::identification::{Assumed, Identified, Observation};
use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::WheelState;
use proptest::prelude::*;

use super::made::NOISE;

fn any_observation() -> impl Strategy<Value = Observation<f64>> {
    let number = || prop_oneof![any::<f64>(), -2.0..2.0, 0.0..100.0, 0.0..1e-3, Just(0.0)];
    let slip = prop_oneof![-1.0..=1.0, Just(0.0), Just(1.0), any::<f64>()];
    let sinkage = prop::option::weighted(0.95, prop_oneof![0.0..0.1, Just(0.0), Just(0.075), 0.0..1e-9, any::<f64>()]);
    let load = prop_oneof![1e-3..1e3, any::<f64>()];
    (number(), load, number(), slip, sinkage).prop_map(|(drawbar_pull_n, load_n, torque_nm, slip, sinkage_m)| {
        Observation { state: WheelState { drawbar_pull_n, load_n, torque_nm, slip, sinkage_m }, noise: NOISE }
    })
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn an_answer_is_of_numbers(wheels in prop::collection::vec(any_observation(), 0..8), cohesion_pa in prop::option::of(0.0..1e4)) {
        let wheel = Wheel { radius_m: 0.075, width_m: 0.070 };
        for bounds in [DingBounds::usual(), DingBounds::usual().with_any_strength()] {
            if let Ok(told) = ding(&wheel, &wheels, &bounds) {
                prop_assert!(is_sound(&told), "{told:?}");
            }
        }
        if let Ok(told) = iagnemma(&wheel, &wheels, &assumed(cohesion_pa)) {
            prop_assert!(is_sound(&told), "{told:?}");
        }
        let wheel = wheel.map(|length| length as f32);
        let wheels: Vec<_> = wheels.iter().map(super::made::single).collect();
        if let Ok(told) = ding(&wheel, &wheels, &DingBounds::usual()) {
            prop_assert!(is_sound(&told), "{told:?}");
        }
        if let Ok(told) = iagnemma(&wheel, &wheels, &assumed(cohesion_pa)) {
            prop_assert!(is_sound(&told), "{told:?}");
        }
    }
}
