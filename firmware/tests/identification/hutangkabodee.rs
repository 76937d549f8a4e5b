//! Hutangkabodee's method: its quadrature against another, its answers against known soils.

use kapvik_firmware::identification::hutangkabodee::{Fit, Steps, fit, hutangkabodee};
use kapvik_firmware::identification::{Observation, Origin, Refusal};
use kapvik_firmware::terramechanics::{Quadrature, Soil, wheel_forces_by};

use super::made::{Normal, averaged, kapvik_wheel, noisy, seen, single, six_wheels, table_1_sand};
use super::worse::worse;

/// The sand with its friction angle, shear modulus and stiffness multiplied.
fn start(angle: f64, modulus: f64, stiffness: f64) -> Soil<f64> {
    let mut soil = table_1_sand();
    soil.friction_angle_rad *= angle;
    soil.shear_modulus_m *= modulus;
    soil.scale_stiffness(stiffness);
    soil
}

/// The greatest relative error of φ, K and k.
fn error(fit: &Fit<f64>) -> f64 {
    let (soil, width_m) = (table_1_sand(), kapvik_wheel().width_m);
    let ratios = [
        fit.identified.friction_angle_rad.value / soil.friction_angle_rad,
        fit.identified.shear_modulus_m.value / soil.shear_modulus_m,
        fit.stiffness.value / soil.stiffness(width_m),
    ];
    ratios.iter().map(|ratio| (ratio - 1.0).abs()).fold(0.0, worse)
}

/// The eight starts a factor of two off.
fn starts_off_by_two() -> impl Iterator<Item = Soil<f64>> {
    let factor = |high: bool| if high { 2.0 } else { 0.5 };
    // Twice 31.9° is no soil; 1.7 times is 54°.
    let angle = |high: bool| if high { 1.7 } else { 0.5 };
    (0..8).map(move |corner| start(angle(corner & 1 > 0), factor(corner & 2 > 0), factor(corner & 4 > 0)))
}

/// Slip, sinkage (m), drawbar pull (N), load (N) and torque (N·m) by SciPy's `simpson` over 21 equal steps of θ on each
/// side of θm, equations 1–11 written down anew.
const SIMPSON: [(f64, f64, f64, f64, f64); 3] = [
    (0.10, 0.0179, -1.774_588_952_267_798, 65.189_663_176_195_96, 1.295_110_867_278_842_3),
    (0.30, 0.0183, 4.756_273_025_944_642, 65.506_385_904_866_69, 1.849_416_857_167_567_8),
    (0.60, 0.0192, 8.408_336_102_508_931, 65.204_778_386_873_14, 2.233_568_263_275_934_4),
];

#[test]
fn simpson_s_rule_is_scipy_s() {
    for (slip, sinkage_m, pull_n, load_n, torque_nm) in SIMPSON {
        let found = wheel_forces_by(&Quadrature::SIMPSON, &kapvik_wheel(), &table_1_sand(), slip, sinkage_m)
            .expect("inputs in range");
        assert!((found.drawbar_pull_n - pull_n).abs() < 1e-9, "{found:?}");
        assert!((found.load_n - load_n).abs() < 1e-9, "{found:?}");
        assert!((found.torque_nm - torque_nm).abs() < 1e-9, "{found:?}");
    }
}

/// Data of the same model by other quadrature: within 2 %, as the method's later users report it of theirs.
#[test]
fn finds_the_soil_from_starts_a_factor_of_two_off() {
    for assumed in starts_off_by_two() {
        let found = fit(&kapvik_wheel(), &six_wheels(&table_1_sand()), &assumed, Steps::Damped).expect("an answer");
        assert!(error(&found) < 0.02, "from {assumed:?}: {found:?}");
    }
}

/// Three samples are enough for Newton–Raphson.
#[test]
fn three_samples_are_enough() {
    let samples = [0.05, 0.25, 0.60].map(|slip| averaged(&seen(&table_1_sand(), slip, 65.4), 100.0));
    for assumed in starts_off_by_two() {
        let found = fit(&kapvik_wheel(), &samples, &assumed, Steps::Damped).expect("an answer");
        assert!(error(&found) < 0.02, "from {assumed:?}: {found:?}");
    }
}

#[test]
fn the_whole_step_of_newton_runs_away_where_the_damped_one_does_not() {
    let observed = six_wheels(&table_1_sand());
    let answered = |steps| {
        starts_off_by_two()
            .filter(|assumed| fit(&kapvik_wheel(), &observed, assumed, steps).is_ok_and(|fit| error(&fit) < 0.02))
            .count()
    };
    assert!(answered(Steps::Whole) < 8);
    assert_eq!(answered(Steps::Damped), 8);
}

#[test]
fn single_precision_finds_it_too() {
    let observed = six_wheels(&table_1_sand()).each_ref().map(single);
    let wheel = kapvik_wheel().map(|length| length as f32);
    for assumed in starts_off_by_two() {
        let found = hutangkabodee(&wheel, &observed, &assumed.map(|number| number as f32)).expect("an answer");
        let sand = table_1_sand();
        let angle = f64::from(found.friction_angle_rad.value) / sand.friction_angle_rad;
        let modulus = f64::from(found.shear_modulus_m.value) / sand.shear_modulus_m;
        assert!((angle - 1.0).abs() < 0.02 && (modulus - 1.0).abs() < 0.02, "from {assumed:?}: {found:?}");
    }
}

/// With the noise that the method knows of, that of the drawbar pull, the truth lies within one standard deviation in
/// 68 % of cases; of 400, four standard deviations of that share are 9 %.
#[test]
fn standard_deviations_cover_what_they_claim() {
    const TRIALS: usize = 400;
    let mut random = Normal::new(1);
    let exact = six_wheels(&table_1_sand()).each_ref().map(|wheel| averaged(wheel, 100.0));
    let (mut angles, mut moduli) = (0, 0);
    for _ in 0..TRIALS {
        let mut observed = exact;
        for observation in &mut observed {
            observation.state.drawbar_pull_n += observation.noise.drawbar_pull_n * random.next();
        }
        let found = hutangkabodee(&kapvik_wheel(), &observed, &table_1_sand()).expect("an answer");
        let within = |value: f64, truth: f64, std: Option<f64>| (value - truth).abs() < std.expect("a deviation");
        let (angle, modulus) = (&found.friction_angle_rad, &found.shear_modulus_m);
        angles += usize::from(within(angle.value, table_1_sand().friction_angle_rad, angle.std));
        moduli += usize::from(within(modulus.value, table_1_sand().shear_modulus_m, modulus.std));
    }
    for inside in [angles, moduli] {
        let share = inside as f64 / TRIALS as f64;
        assert!(share > 0.68 - 0.09, "{share}");
    }
}

/// The method takes slip and sinkage as exact; what their noise does shows in the residuals, and widens the standard
/// deviations by as much. Of 200 cases, four standard deviations of the share inside are 13 %.
#[test]
fn noise_of_slip_and_sinkage_shows_in_the_residuals() {
    const TRIALS: usize = 200;
    let mut random = Normal::new(2);
    let truth = table_1_sand().friction_angle_rad;
    let exact = six_wheels(&table_1_sand()).each_ref().map(|wheel| averaged(wheel, 100.0));
    let (mut angles, mut inside) = (Vec::new(), 0);
    for _ in 0..TRIALS {
        let observed = exact.each_ref().map(|wheel| noisy(wheel, &mut random));
        let angle = hutangkabodee(&kapvik_wheel(), &observed, &table_1_sand()).expect("an answer").friction_angle_rad;
        angles.push(angle.value);
        inside += usize::from((angle.value - truth).abs() < angle.std.expect("a deviation"));
    }
    angles.sort_by(f64::total_cmp);
    assert!(inside as f64 / TRIALS as f64 > 0.68 - 0.13, "{inside}");
    assert!((angles[TRIALS / 2] / truth - 1.0).abs() < 0.02);
}

#[test]
fn refuses_for_a_named_reason() {
    let (wheel, sand) = (kapvik_wheel(), table_1_sand());
    let identify = |observed: &[Observation<f64>]| hutangkabodee(&wheel, observed, &sand).err();
    let observed = six_wheels(&sand);
    assert_eq!(identify(&observed[..2]), Some(Refusal::TooFew { needed: 3 }));

    let mut braking = observed;
    braking[..4].iter_mut().for_each(|observation| observation.state.slip = -0.1);
    assert_eq!(identify(&braking), Some(Refusal::TooFew { needed: 3 }));

    let mut blind = observed;
    blind[3].state.sinkage_m = None;
    assert_eq!(identify(&blind), Some(Refusal::NoSinkage));

    let mut buried = observed;
    buried[3].state.sinkage_m = Some(0.1);
    assert_eq!(identify(&buried), Some(Refusal::OutOfRange));

    assert_eq!(identify(&[observed[2]; 6]), Some(Refusal::NotIdentifiable));
    let mut absurd = observed;
    absurd[1].state.drawbar_pull_n = f64::NAN;
    assert_eq!(identify(&absurd), Some(Refusal::NotFinite));
}

#[test]
fn cohesion_is_said_to_be_assumed() {
    let found = hutangkabodee(&kapvik_wheel(), &six_wheels(&table_1_sand()), &table_1_sand()).expect("an answer");
    assert_eq!(found.cohesion_pa.origin, Origin::Assumed);
    assert_eq!(found.cohesion_pa.value, 250.0);
    assert_eq!(found.friction_angle_rad.origin, Origin::Estimated);
}
