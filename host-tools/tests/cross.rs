//! The earlier network of the literature: trained in seconds, the same each time, as good as a single wheel allows.

#[path = "../../firmware/tests/support/six_slips.rs"]
mod six_slips;

use std::sync::LazyLock;

use kapvik_firmware::identification::{Observation, Refusal};
use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::WheelState;
use kapvik_host::prior::KAPVIK_INSTANT_NOISE;
use kapvik_host::soil_catalogue::TABLE_1;
use kapvik_host::train::cross::{Scope, Trained, train};
use six_slips::SIX_SLIPS;

const SEED: u64 = 1;
static TRAINED: LazyLock<Trained> = LazyLock::new(|| train(&Scope::KAPVIK, SEED));

/// Six wheels at slips of 0.05 … 0.60 under one load, without noise.
fn six_wheels(wheel: &Wheel<f64>, load_n: f64) -> [Observation<f64>; 6] {
    SIX_SLIPS.map(|slip| {
        let state = WheelState::under_load(wheel, &TABLE_1, slip, load_n).expect("carried");
        Observation { state, noise: KAPVIK_INSTANT_NOISE }
    })
}

#[test]
fn the_same_seed_gives_the_same_network() {
    assert_eq!(train(&Scope::KAPVIK, SEED), *TRAINED);
}

/// One wheel says next to nothing of cohesion. With n, k, c₁ and c₂ known and no noise, a network three times the size was
/// seen to explain 80 % of φ and 97 % of ln K elsewhere; with these open, 32 % and 63 % (with noise). This one, which
/// has no noise but must do without them, lies between.
#[test]
fn held_out_errors_are_what_one_wheel_allows() {
    let held_out = TRAINED.held_out;
    let [cohesion, angle, modulus] = held_out.determination;
    assert!(held_out.count >= 1000);
    assert!((-0.05..0.2).contains(&cohesion), "{held_out:?}");
    assert!((0.25..0.80).contains(&angle), "{held_out:?}");
    assert!((0.45..0.97).contains(&modulus), "{held_out:?}");
}

#[test]
fn the_seed_s_sand_is_found_within_the_held_out_error() {
    let found = TRAINED.network.identify(&six_wheels(&Scope::KAPVIK.wheel, 65.4)).expect("an answer");
    let [_, angle_error, modulus_error] = TRAINED.held_out.error;
    assert!((found.friction_angle_rad.value - TABLE_1.friction_angle_rad).abs() < 2.0 * angle_error);
    assert!((found.shear_modulus_m.value / TABLE_1.shear_modulus_m).ln().abs() < 2.0 * modulus_error);
    assert!(found.cohesion_pa.std.is_none() && !found.cohesion_pa.identifiable);
    assert!(found.condition_number >= 1.0 && found.condition_number.is_finite());
}

/// A wheel of the 2011 single-wheel study, under its loads.
#[test]
fn another_wheel_is_trained_for() {
    let wheel = Wheel { radius_m: 0.157, width_m: 0.165 };
    let trained = train(&Scope::around(wheel, 30.0, 150.0), SEED);
    let found = trained.network.identify(&six_wheels(&wheel, 80.0)).expect("an answer");
    assert!((found.friction_angle_rad.value - TABLE_1.friction_angle_rad).abs() < 2.0 * trained.held_out.error[1]);
    let refused = TRAINED.network.identify(&six_wheels(&wheel, 150.0));
    assert_eq!(refused.err(), Some(Refusal::OutOfRange), "the network of a small wheel knows no such load");
}

#[test]
fn refuses_for_a_named_reason() {
    let observed = six_wheels(&Scope::KAPVIK.wheel, 65.4);
    let identify = |observed: &[Observation<f64>]| TRAINED.network.identify(observed).err();
    assert_eq!(identify(&[]), Some(Refusal::TooFew { needed: 1 }));
    let mut blind = observed;
    blind[0].state.sinkage_m = None;
    assert_eq!(identify(&blind), Some(Refusal::NoSinkage));
    let mut absurd = observed;
    absurd[0].state.torque_nm = f64::NAN;
    assert_eq!(identify(&absurd), Some(Refusal::NotFinite));
    let braking = observed.map(|mut observation| {
        observation.state.slip = -0.3;
        observation
    });
    assert_eq!(identify(&braking), Some(Refusal::OutOfRange));
}
