//! Effects against their closed forms (METHODS.md, section 13), written down anew.

use kapvik_firmware::scalar::Scalar;
use kapvik_firmware::terramechanics::effects::{Conditions, Effects};
use kapvik_firmware::terramechanics::{Memory, Readings, WheelOnSoil, WheelTruth};

use super::effects::{LOAD_N, SAND, WHEEL, on_sand, state, with};

/// Slips of a wheel that drives and of one that brakes, whose drawbar pulls have other signs.
const BOTH_WAYS: [f64; 2] = [0.3, -0.3];

/// What sensors with these effects read of a wheel.
fn read(effects: &Effects<f64>, conditions: &Conditions<f64>, truth: &WheelTruth<f64>) -> Readings<f64> {
    on_sand(effects).readings(conditions, truth, &mut Memory::start())
}

/// By how much drawbar pull, load and side force are read otherwise than they are.
fn misread(effects: &Effects<f64>, conditions: &Conditions<f64>, truth: &WheelTruth<f64>) -> [f64; 3] {
    let read = read(effects, conditions, truth);
    assert_eq!((read.torque_nm, read.sinkage_m, read.slip), (truth.torque_nm, truth.sinkage_m, truth.slip));
    [read.drawbar_pull_n - truth.drawbar_pull_n, read.load_n - truth.load_n, read.side_force_n - truth.side_force_n]
}

/// A wheel that drives or brakes askew, so that no force is zero.
fn askew(slip: f64) -> WheelTruth<f64> {
    let conditions = Conditions { slip_angle_rad: Some(0.2), ..Conditions::default() };
    let truth = state(&with(&[("lateral-slip", "shear", 1.0)]), &conditions, slip);
    assert!(truth.side_force_n > 1.0 && truth.drawbar_pull_n.abs() > 1.0, "{truth:?}");
    truth
}

fn is_close(found: [f64; 3], expected: [f64; 3]) -> bool {
    found.into_iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12)
}

#[test]
fn sinkage_follows_travel() {
    let effects = with(&[("sinkage-lag", "length_m", 0.05), ("sinkage-lag", "start", 0.0)]);
    let settled = state(&effects, &Conditions::default(), 0.3);
    let mut memory = Memory::start();
    for travel in [0.01, 0.02, 0.05, 0.1, 0.4] {
        let conditions = Conditions { travel_m: Some(travel), ..Conditions::default() };
        let read = on_sand(&effects).readings(&conditions, &settled, &mut memory);
        let closed_form = settled.sinkage_m * (1.0 - (-travel / 0.05_f64).exp());
        assert!((read.sinkage_m - closed_form).abs() < 1e-12);
    }
}

/// A wheel whose radius is taken 5 % too great, at v/(rω) = 0.8 and at a standstill of slip.
#[test]
fn slip_with_a_wrong_radius() {
    let effects = with(&[("rolling-radius", "excess", 0.05)]);
    let read = |slip: f64| {
        let truth = state(&Effects::none(), &Conditions::default(), slip);
        on_sand(&effects).readings(&Conditions::default(), &truth, &mut Memory::start()).slip
    };
    assert!((read(0.2) - (1.0 - 0.8 / 1.05)).abs() < 1e-12);
    assert!((read(0.0) - (1.0 - 1.0 / 1.05)).abs() < 1e-12);
    // rω/v = 0.98 is read as 1.029: driving.
    assert!((read(-0.02) - (1.0 - 1.0 / (0.98 * 1.05))).abs() < 1e-12);
    assert!((read(-0.5) - (0.5 * 1.05 - 1.0)).abs() < 1e-12);
}

#[test]
fn stronger_soil_keeps_its_angle_below_upright() {
    let mut soil = SAND;
    soil.scale_strength(2.0);
    assert!((soil.friction_angle_rad.tan() - 2.0 * SAND.friction_angle_rad.tan()).abs() < 1e-12);
    assert_eq!(soil.cohesion_pa, 500.0);
    assert!(Scalar::is_finite(soil.friction_angle_rad));
}

/// ρ b z v² of the swept soil comes off the drawbar pull, and nothing else changes.
#[test]
fn excavated_soil_takes_its_momentum() {
    let conditions = Conditions { speed_m_s: Some(0.5), ..Conditions::default() };
    let (plain, slowed) =
        (state(&Effects::none(), &conditions, 0.3), state(&with(&[("rate", "excavation", 1.0)]), &conditions, 0.3));
    let momentum_n = 1600.0 * WHEEL.width_m * plain.sinkage_m * 0.5 * 0.5;
    assert!((plain.drawbar_pull_n - slowed.drawbar_pull_n - momentum_n).abs() < 1e-12);
    assert_eq!((plain.torque_nm, plain.sinkage_m), (slowed.torque_nm, slowed.sinkage_m));
}

/// A drift that settles is the closed form, and the line where it does not settle.
#[test]
fn drift_settles() {
    let read = |settling_per_h: f64, hours: f64| {
        let effects = with(&[("force-drift", "load_n_per_h", 2.0), ("force-drift", "settling_per_h", settling_per_h)]);
        let conditions = Conditions { hours_since_zero: Some(hours), ..Conditions::default() };
        let truth = state(&Effects::none(), &conditions, 0.3);
        on_sand(&effects).readings(&conditions, &truth, &mut Memory::start()).load_n - truth.load_n
    };
    assert!((read(0.0, 3.0) - 6.0).abs() < 1e-12);
    assert!((read(1.0, 3.0) - 2.0 * (1.0 - (-3.0_f64).exp())).abs() < 1e-12);
    // The two ways of computing it meet where one takes over from the other.
    assert!((read(0.999e-3, 1.0) - read(1.001e-3, 1.0)).abs() < 3e-6);
}

/// A second pass over soil that gains half its strength in the limit.
#[test]
fn strength_grows_with_passes() {
    let conditions = Conditions { pass: Some(2.0), ..Conditions::default() };
    let stronger = state(&with(&[("multi-pass", "strength", 0.5)]), &conditions, 0.3);
    let mut soil = SAND;
    soil.scale_strength(1.0 + 0.5 * (1.0 - (-1.0_f64).exp()));
    let nothing = Effects::none();
    let expected = WheelOnSoil { soil: &soil, ..on_sand(&nothing) }.at_load(&conditions, 0.3, LOAD_N).expect("carried");
    assert!((stronger.drawbar_pull_n - expected.drawbar_pull_n).abs() < 1e-9);
}

/// R = γ b (z² − z₀²) N_φ/2 + 2 c b (z − z₀) √N_φ beyond z₀, off the drawbar pull alone; nothing where the wheel is shallower.
#[test]
fn soil_that_is_pushed_resists_by_its_passive_pressure() {
    let plain = state(&Effects::none(), &Conditions::default(), 0.3);
    let passive = (std::f64::consts::FRAC_PI_4 + SAND.friction_angle_rad / 2.0).tan().powi(2);
    for onset in [0.0, 0.1, 0.5] {
        let begins_m = (onset * WHEEL.radius_m).min(plain.sinkage_m);
        let weight = 0.5 * 1600.0 * 9.81 * (plain.sinkage_m.powi(2) - begins_m.powi(2)) * passive;
        let cohesion = 2.0 * SAND.cohesion_pa * (plain.sinkage_m - begins_m) * passive.sqrt();
        let effects = with(&[("bulldozing", "share", 1.0), ("bulldozing", "onset", onset)]);
        let pushing = state(&effects, &Conditions::default(), 0.3);
        let resistance_n = plain.drawbar_pull_n - pushing.drawbar_pull_n;
        let expected_n = WHEEL.width_m * (weight + cohesion);
        assert!((resistance_n - expected_n).abs() < 1e-9, "{onset}: {resistance_n}, {expected_n}");
        assert_eq!((plain.torque_nm, plain.sinkage_m), (pushing.torque_nm, pushing.sinkage_m));
        assert_eq!(onset == 0.5, expected_n == 0.0, "the sand carries the wheel at less than half its radius");
    }
}

/// Size of the line at so many periods a turn of the wheel.
fn line(turn: &[f64], periods: usize) -> f64 {
    let part = |of: fn(f64) -> f64| {
        let at = |place: usize| of(std::f64::consts::TAU * (place * periods) as f64 / turn.len() as f64);
        turn.iter().enumerate().map(|(place, value)| value * at(place)).sum::<f64>()
    };
    2.0 / turn.len() as f64 * part(f64::sin).hypot(part(f64::cos))
}

/// A turn of the wheel, ten looks at each of its 24 grousers.
fn turn(effects: &Effects<f64>, of: fn(&Readings<f64>) -> f64) -> Vec<f64> {
    let at = |place: usize| {
        let angle_rad = std::f64::consts::TAU * place as f64 / 240.0;
        let conditions = Conditions { wheel_angle_rad: Some(angle_rad), ..Conditions::default() };
        of(&read(effects, &conditions, &state(effects, &conditions, 0.3)))
    };
    (0..240).map(at).collect()
}

/// A channel that swings has one line, as large as its sine and cosine parts together; stresses that swing have lines at the grouser
/// count and its multiples alone.
#[test]
fn grousers_make_a_line_at_their_count_per_turn() {
    let pull = with(&[("grouser-ripple", "drawbar_pull_sin_n", 0.6), ("grouser-ripple", "drawbar_pull_cos_n", 0.8)]);
    let pull = turn(&pull, |read| read.drawbar_pull_n);
    assert!((line(&pull, 24) - 1.0).abs() < 1e-9, "{}", line(&pull, 24));
    assert!((1..120).filter(|periods| *periods != 24).all(|periods| line(&pull, periods) < 1e-9));
    let sinkage = turn(&with(&[("grouser-ripple", "stress_sin", 0.1)]), |read| read.sinkage_m);
    assert!(line(&sinkage, 24) > 20.0 * line(&sinkage, 48) && line(&sinkage, 48) > 0.0, "{}", line(&sinkage, 24));
    assert!((1..120).filter(|periods| periods % 24 > 0).all(|periods| line(&sinkage, periods) < 1e-9));
}

/// W − μ |DP|: whether the wheel drives or brakes, load is lost.
#[test]
fn a_guide_loses_load_by_the_size_of_the_drawbar_pull() {
    let effects = with(&[("guide-friction", "mu", 0.1)]);
    for slip in BOTH_WAYS {
        let truth = askew(slip);
        let lost_n = 0.1 * truth.drawbar_pull_n.abs();
        assert!(is_close(misread(&effects, &Conditions::default(), &truth), [0.0, -lost_n, 0.0]), "{slip}");
    }
}

/// DP + W sin(tilt + share · pitch) + w sin(pitch): of a degree, 1.14 N of the 65.4 N on the wheel.
#[test]
fn gravity_leaks_into_the_drawbar_pull() {
    let truth = askew(0.3);
    let leak = |parameter: &str, value: f64, pitch_rad: Option<f64>| {
        let conditions = Conditions { pitch_rad, ..Conditions::default() };
        let [pull_n, load_n, side_n] = misread(&with(&[("pitch-misalignment", parameter, value)]), &conditions, &truth);
        assert_eq!((load_n, side_n), (0.0, 0.0));
        pull_n
    };
    for (tilt_deg, expected_n) in [(1.0_f64, 1.1414), (-1.0, -1.1414)] {
        let found_n = leak("tilt_rad", tilt_deg.to_radians(), None);
        assert!((found_n - expected_n).abs() < 1e-4, "{tilt_deg}°: {found_n}");
    }
    for pitch_rad in [0.2_f64, -0.2] {
        let [by_share_n, own_n] = [("pitch_share", 0.3), ("own_weight_n", 5.0)]
            .map(|(parameter, value)| leak(parameter, value, Some(pitch_rad)));
        assert!((by_share_n - LOAD_N * (0.3 * pitch_rad).sin()).abs() < 1e-12, "{by_share_n}");
        assert!((own_n - 5.0 * pitch_rad.sin()).abs() < 1e-12, "{own_n}");
    }
}

/// A share of one force, with its sign, in another channel, and nothing in any other.
#[test]
fn forces_leak_into_one_channel_with_their_sign() {
    type Force = fn(&WheelTruth<f64>) -> f64;
    let (pull, load, side): (Force, Force, Force) =
        (|truth| truth.drawbar_pull_n, |truth| truth.load_n, |truth| truth.side_force_n);
    let torque: Force = |truth| truth.torque_nm;
    let forms: [(&str, Force, usize); 8] = [
        ("drawbar_pull_to_load", pull, 1),
        ("drawbar_pull_to_side_force", pull, 2),
        ("load_to_drawbar_pull", load, 0),
        ("load_to_side_force", load, 2),
        ("side_force_to_drawbar_pull", side, 0),
        ("side_force_to_load", side, 1),
        ("torque_to_drawbar_pull_per_m", torque, 0),
        ("torque_to_load_per_m", torque, 1),
    ];
    for (parameter, from, into) in forms {
        for (slip, share) in BOTH_WAYS.into_iter().flat_map(|slip| [0.05, -0.05].map(|share| (slip, share))) {
            let truth = askew(slip);
            let mut expected = [0.0; 3];
            expected[into] = share * from(&truth);
            let found = misread(&with(&[("crosstalk", parameter, share)]), &Conditions::default(), &truth);
            assert!(is_close(found, expected), "{parameter} {share} at {slip}: {found:?}, {expected:?}");
        }
    }
}

/// By degrees from the temperature of no offset, which is 20 °C where nothing else is said.
#[test]
fn an_offset_grows_with_the_temperature() {
    let truth = askew(0.3);
    for (channel, parameter) in ["drawbar_pull_n_per_c", "load_n_per_c", "side_force_n_per_c"].into_iter().enumerate() {
        let drift = [("force-drift", parameter, 0.2)];
        let from_zero = [&drift[..], &[("force-drift", "reference_c", 0.0)]].concat();
        for (settings, temperature_c, offset_n) in
            [(&drift[..], 20.0, 0.0), (&drift[..], 35.0, 3.0), (&drift[..], -30.0, -10.0), (&from_zero[..], 35.0, 7.0)]
        {
            let conditions = Conditions { temperature_c: Some(temperature_c), ..Conditions::default() };
            let mut expected = [0.0; 3];
            expected[channel] = offset_n;
            let found = misread(&with(settings), &conditions, &truth);
            assert!(is_close(found, expected), "{parameter} at {temperature_c} °C: {found:?}");
        }
    }
}
