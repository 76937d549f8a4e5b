//! Effects against figures of an independent implementation: the change of drawbar pull, torque and sinkage of the assumed
//! Kapvik wheel on the seed's sand under 65.4 N, at slips of 0.1, 0.3 and 0.6 (the catalogue of effects in the
//! project's notes on methods, section 13, computed with other code).

use kapvik_firmware::terramechanics::effects::{CATALOGUE, Conditions, Effects, Grousers};
use kapvik_firmware::terramechanics::{
    Memory, Quadrature, Readings, Soil, Wheel, WheelOnSoil, WheelTruth, sinkage_for_load, wheel_forces,
};

use super::{kapvik_wheel, table_1_sand};

pub(super) const WHEEL: Wheel<f64> = kapvik_wheel();
pub(super) const SAND: Soil<f64> = table_1_sand();
const GROUSERS: Grousers<f64> = Grousers { height_m: 0.005, count: 24.0 };
pub(super) const LOAD_N: f64 = 65.4;
const SLIPS: [f64; 3] = [0.1, 0.3, 0.6];
const EVERYTHING_KNOWN: Conditions<f64> = Conditions {
    pass: Some(2.0),
    temperature_c: Some(31.0),
    hours_since_zero: Some(3.0),
    speed_m_s: Some(0.015),
    wheel_rate_rad_s: Some(0.3),
    wheel_angle_rad: Some(12.3),
    travel_m: Some(0.4),
    pitch_rad: Some(0.1),
    slip_angle_rad: Some(0.2),
    felt_slip: Some(0.25),
};

pub(super) fn on_sand(effects: &Effects<f64>) -> WheelOnSoil<'_, f64> {
    WheelOnSoil {
        wheel: &WHEEL,
        grousers: &GROUSERS,
        soil: &SAND,
        effects,
        gravity_m_s2: 9.81,
        quadrature: Quadrature::REFERENCE,
    }
}

pub(super) fn state(effects: &Effects<f64>, conditions: &Conditions<f64>, slip: f64) -> WheelTruth<f64> {
    on_sand(effects).at_load(conditions, slip, LOAD_N).expect("the sand carries it")
}

pub(super) fn with(settings: &[(&str, &str, f64)]) -> Effects<f64> {
    let mut effects = Effects::none();
    for (id, parameter, value) in settings {
        assert!(effects.set(id, parameter, *value), "{id} {parameter}");
    }
    effects
}

/// Changes in N, N·m and mm at the three slips; each is printed to two digits or so.
fn check(settings: &[(&str, &str, f64)], expected: [[f64; 3]; 3]) {
    let effects = with(settings);
    for (slip, [pull, torque, sinkage]) in SLIPS.into_iter().zip(expected) {
        let conditions = Conditions::default();
        let (before, after) = (state(&Effects::none(), &conditions, slip), state(&effects, &conditions, slip));
        let near = |what: &str, change: f64, expected: f64, digit: f64| {
            let tolerance = digit.max(0.03 * expected.abs());
            assert!((change - expected).abs() <= tolerance, "{settings:?} at {slip}: {what} {change} for {expected}");
        };
        near("drawbar pull", after.drawbar_pull_n - before.drawbar_pull_n, pull, 0.06);
        near("torque", after.torque_nm - before.torque_nm, torque, 0.006);
        near("sinkage", 1e3 * (after.sinkage_m - before.sinkage_m), sinkage, 0.06);
    }
}

#[test]
fn slip_sinkage() {
    check(&[("slip-sinkage", "n1", 0.3)], [[0.37, 0.08, 1.5], [0.06, 0.18, 4.7], [-2.7, 0.20, 10.6]]);
}

/// Soil that has felt another slip than the present one: the wheel shears by its slip and sinks by the soil's.
#[test]
fn slip_sinkage_where_the_soil_has_felt_another_slip() {
    let effects = with(&[("slip-sinkage", "n1", 0.3), ("slip-sinkage", "apparent", 0.5)]);
    for (slip, felt) in [(1.0, 0.0), (0.3, 0.6), (0.1, -0.5)] {
        let conditions = Conditions { felt_slip: Some(felt), ..Conditions::default() };
        let found = state(&effects, &conditions, slip);
        let soil = Soil { sinkage_exponent: 1.1 + 0.3 * f64::abs(felt), ..SAND };
        let sinkage_m = sinkage_for_load(&WHEEL, &soil, slip, LOAD_N).expect("carried");
        let expected = wheel_forces(&WHEEL, &soil, slip, sinkage_m).expect("in range");
        assert!((found.sinkage_m - sinkage_m).abs() < 1e-9, "{slip} {felt}: {} for {sinkage_m}", found.sinkage_m);
        assert!((found.drawbar_pull_n - expected.drawbar_pull_n).abs() < 1e-6, "{slip} {felt}");
        let read = on_sand(&effects).readings(&conditions, &found, &mut Memory::start());
        assert!((read.sinkage_m / found.sinkage_m - (1.0 + 0.5 * f64::abs(felt))).abs() < 1e-12, "{slip} {felt}");
    }
    assert_eq!(state(&effects, &Conditions::default(), 0.3), {
        let conditions = Conditions { felt_slip: Some(0.3), ..Conditions::default() };
        state(&effects, &conditions, 0.3)
    });
}

#[test]
fn interface_friction() {
    check(
        &[("interface-friction", "delta", 20_f64.to_radians())],
        [[0.0, 0.0, 0.0], [-3.4, -0.25, 0.1], [-8.3, -0.58, 0.4]],
    );
}

#[test]
fn rear_contact() {
    check(&[("rear-contact", "eta", 0.2)], [[7.8, -0.04, -3.5], [9.5, 0.11, -3.5], [10.3, 0.17, -3.6]]);
}

#[test]
fn peak_stress_shift() {
    check(&[("peak-stress-shift", "shift", 0.1)], [[-1.5, 0.04, 1.2], [-2.1, 0.01, 1.4], [-2.7, -0.01, 1.8]]);
}

/// Coefficients of equation 10 are free beyond what keeps the peak inside the contact: skidding at 0.8, this soil has it behind the exit by
/// its own ones, and inside by the shifted ones.
#[test]
fn peak_stress_shift_from_outside_the_contact() {
    let soil = |peak_stress_c1| Soil { peak_stress_c1, ..SAND };
    let (own, shifted) = (soil(0.1), soil(0.4));
    assert!(own.peak_stress_c1 - 0.8 * own.peak_stress_c2 < 0.0);
    let effects = with(&[("peak-stress-shift", "shift", 0.3)]);
    let on_own = WheelOnSoil { soil: &own, ..on_sand(&effects) };
    let found = on_own.forces(&Conditions::default(), -0.8, LOAD_N, 0.01).expect("in range");
    let expected = wheel_forces(&WHEEL, &shifted, -0.8, 0.01).expect("in range");
    assert!((found.load_n - expected.load_n).abs() < 1e-9, "{} for {}", found.load_n, expected.load_n);
    assert!((found.torque_nm - expected.torque_nm).abs() < 1e-9);
}

/// The figures of the notes are of drawbar pull and torque alone.
fn check_forces(settings: &[(&str, &str, f64)], expected: [[f64; 2]; 3]) {
    let effects = with(settings);
    for (slip, [pull, torque]) in SLIPS.into_iter().zip(expected) {
        let conditions = Conditions::default();
        let (before, after) = (state(&Effects::none(), &conditions, slip), state(&effects, &conditions, slip));
        let (by_pull, by_torque) = (after.drawbar_pull_n - before.drawbar_pull_n, after.torque_nm - before.torque_nm);
        assert!((by_pull - pull).abs() <= 0.06_f64.max(0.04 * pull.abs()), "{settings:?} at {slip}: {by_pull}, {pull}");
        assert!((by_torque - torque).abs() <= 0.006_f64.max(0.04 * torque), "{settings:?}: {by_torque}, {torque}");
    }
}

#[test]
fn grousers_of_five_millimetres() {
    check_forces(&[("grouser-thrust", "lambda", 1.0)], [[5.35, 0.49], [5.2, 0.51], [4.5, 0.48]]);
}

/// Blades over a contact of no length: the limit is finite.
#[test]
fn grousers_that_hardly_touch() {
    for settings in [[("grouser-thrust", "lambda", 1.0)], [("grouser-thrust", "blade", 0.5)]] {
        let effects = with(&settings);
        let at = |sinkage_m: f64| on_sand(&effects).forces(&Conditions::default(), 0.2, LOAD_N, sinkage_m);
        let (none, hardly) = (at(0.0).expect("a state"), at(1.0e-9).expect("a state"));
        assert!((none.drawbar_pull_n - hardly.drawbar_pull_n).abs() < 0.01, "{settings:?}: {none:?}, {hardly:?}");
    }
}

#[test]
fn shear_hump() {
    check_forces(
        &[("shear-hump", "share", 1.0), ("shear-hump", "residual", 0.7)],
        [[15.8, 1.12], [11.5, 0.80], [4.1, 0.27]],
    );
}

#[test]
fn lateral_slip() {
    let effects = with(&[("lateral-slip", "shear", 1.0)]);
    let expected = [(-1.2, 12.0), (-0.5, 7.6), (-0.1, 3.2)];
    for (slip, (pull, side)) in SLIPS.into_iter().zip(expected) {
        let straight = state(&effects, &Conditions::default(), slip);
        let left = Conditions { slip_angle_rad: Some(10_f64.to_radians()), ..Conditions::default() };
        let right = Conditions { slip_angle_rad: Some(-10_f64.to_radians()), ..Conditions::default() };
        let (left, right) = (state(&effects, &left, slip), state(&effects, &right, slip));
        assert!((left.drawbar_pull_n - straight.drawbar_pull_n - pull).abs() < 0.1, "{slip}: {}", left.drawbar_pull_n);
        assert!((left.side_force_n - side).abs() < 0.3, "{slip}: {}", left.side_force_n);
        assert_eq!(straight.side_force_n, 0.0);
        assert!((left.side_force_n + right.side_force_n).abs() < 1e-9 && left.drawbar_pull_n == right.drawbar_pull_n);
    }
}

/// Without effects, and with every effect at its neutral parameters, the states are those of equations 1–11.
#[test]
fn neutral_effects_are_the_seed() {
    let conditions = EVERYTHING_KNOWN;
    for slip in [-0.6, -0.1, 0.0, 0.1, 0.4, 0.8] {
        let sinkage_m = sinkage_for_load(&WHEEL, &SAND, slip, LOAD_N).expect("carried");
        let seed = wheel_forces(&WHEEL, &SAND, slip, sinkage_m).expect("in range");
        let none = on_sand(&Effects::none()).forces(&conditions, slip, LOAD_N, sinkage_m).expect("in range");
        let bits =
            [(none.drawbar_pull_n, seed.drawbar_pull_n), (none.load_n, seed.load_n), (none.torque_nm, seed.torque_nm)];
        assert!(bits.iter().all(|(a, b)| a.to_bits() == b.to_bits()), "at slip {slip}: {none:?} {seed:?}");
        assert_eq!(on_sand(&Effects::none()).at_load(&conditions, slip, LOAD_N).expect("carried").sinkage_m, sinkage_m);
        for info in CATALOGUE {
            let mut effects = Effects::none();
            assert!(effects.add(info.id));
            let on_sand = on_sand(&effects);
            let truth = on_sand.forces(&conditions, slip, LOAD_N, sinkage_m).expect("in range");
            let read = on_sand.readings(&conditions, &truth, &mut Memory::start());
            let seed = Readings::of(&none);
            for (value, seed, size) in [
                (read.drawbar_pull_n, seed.drawbar_pull_n, LOAD_N),
                (read.torque_nm, seed.torque_nm, 1.0),
                (read.load_n, seed.load_n, LOAD_N),
                (read.sinkage_m, seed.sinkage_m, 0.01),
                (read.slip, seed.slip, 1.0),
                (read.side_force_n, 0.0, LOAD_N),
            ] {
                assert!((value - seed).abs() <= 1e-12 * size, "{} at {slip}: {value} for {seed}", info.id);
            }
        }
    }
}

/// Every parameter of every form is known, in its range, and changes something where its columns are given.
#[test]
fn every_form_is_whole() {
    let conditions = EVERYTHING_KNOWN;
    assert_eq!(CATALOGUE.len(), 22);
    for info in CATALOGUE {
        for form in info.forms {
            for name in form.free {
                let parameter = info.parameter(name).unwrap_or_else(|| panic!("{} {name}", info.id));
                assert!(parameter.low <= parameter.neutral || info.id == "interface-friction");
                assert!(
                    parameter.low < parameter.high && (parameter.low..=parameter.high).contains(&parameter.typical)
                );
                let mut settings: Vec<_> = form.set.iter().map(|(name, value)| (info.id, *name, *value)).collect();
                // Parameters that shape another are seen only beside it.
                settings.extend(form.free.iter().map(|free| {
                    let typical = info.parameter(free).expect("known").typical;
                    (info.id, *free, if free == name { 1.3 * typical } else { typical })
                }));
                let changed = with(&settings);
                settings.retain(|(_, free, _)| free != name);
                let without = with(&settings);
                let side = with(&[("lateral-slip", "shear", 1.0)]);
                let read = |mut effects: Effects<f64>| {
                    effects.lateral_slip = effects.lateral_slip.or(side.lateral_slip);
                    // Two rows, as one effect carries the sinkage from row to row.
                    let mut memory = Memory::start();
                    [0.3, 0.5].map(|slip| {
                        let conditions = Conditions { travel_m: Some(0.1 * slip), ..conditions };
                        let truth = on_sand(&effects).at_load(&conditions, slip, LOAD_N).expect("carried");
                        on_sand(&effects).readings(&conditions, &truth, &mut memory)
                    })
                };
                assert_ne!(read(changed), read(without), "{} {} {name}", info.id, form.name);
            }
        }
    }
}

/// An effect under which forces at a sinkage hang on the load says so: who simulates it at a given sinkage has to look for the load, then.
#[test]
fn effects_say_whether_they_follow_the_load() {
    let mut following = 0;
    for info in CATALOGUE {
        for form in info.forms {
            let typical = form.free.iter().map(|name| (info.id, *name, info.parameter(name).expect("known").typical));
            let settings: Vec<_> =
                form.set.iter().map(|(name, value)| (info.id, *name, *value)).chain(typical).collect();
            let effects = with(&settings);
            let under = |load_n| on_sand(&effects).forces(&EVERYTHING_KNOWN, 0.3, load_n, 0.01).expect("forces");
            let hangs_on_it = under(40.0) != under(90.0);
            assert!(effects.follow_load() || !hangs_on_it, "{} {}", info.id, form.name);
            following += usize::from(hangs_on_it);
        }
    }
    assert_eq!(following, 3, "two forms of load-stiffening, and the blades of grousers");
}
