//! Iagnemma's line taken up point by point, with forgetting.

use kapvik_firmware::identification::Refusal;
use kapvik_firmware::identification::iagnemma::{Recursive, iagnemma};
use kapvik_firmware::terramechanics::Soil;

use super::drawn::{any_pattern, draw, loaded};
use super::iagnemma::assumptions;
use super::made::{Normal, averaged, kapvik_wheel, noisy, seen, table_1_sand};

#[test]
fn without_forgetting_it_is_the_batch() {
    let mut random = Normal::new(6);
    let wheels: Vec<_> =
        (0..20).flat_map(|_| draw(&loaded(0.5, &any_pattern(&mut random)), 1.0, &mut random)).collect();
    for cohesion_pa in [None, Some(200.0)] {
        let assumed = assumptions(cohesion_pa);
        let mut line = Recursive::new(&assumed, 1.0).expect("in range");
        for (count, wheel) in wheels.iter().enumerate() {
            line.add(&kapvik_wheel(), wheel).expect("taken up");
            assert_eq!(line.identified(), iagnemma(&kapvik_wheel(), &wheels[..=count], &assumed), "after {count}");
        }
    }
}

#[test]
fn it_says_nothing_before_there_is_enough() {
    let mut line = Recursive::new(&assumptions(None), 0.99).expect("in range");
    let first = seen(&table_1_sand(), 0.2, 65.4);
    assert_eq!(line.identified().map(|_| ()), Err(Refusal::TooFew { needed: 2 }));
    line.add(&kapvik_wheel(), &first).expect("taken up");
    assert_eq!(line.identified().map(|_| ()), Err(Refusal::TooFew { needed: 2 }));
    // A braking wheel is left out; a bad one is refused, and changes nothing.
    let before = line;
    let mut braking = first;
    braking.state.slip = -0.2;
    assert_eq!(line.add(&kapvik_wheel(), &braking), Ok(()));
    let mut bad = first;
    bad.state.sinkage_m = None;
    assert_eq!(line.add(&kapvik_wheel(), &bad), Err(Refusal::NoSinkage));
    assert_eq!(line, before);
    line.add(&kapvik_wheel(), &seen(&table_1_sand(), 0.4, 80.0)).expect("taken up");
    assert!(line.identified().is_ok());
    for forgetting in [0.0, 1.1, f64::NAN] {
        assert_eq!(Recursive::new(&assumptions(None), forgetting), Err(Refusal::OutOfRange));
    }
}

/// The weighted sums written out: an equation k steps old counts for λᵏ.
#[test]
fn an_old_equation_counts_for_less() {
    let forgetting: f64 = 0.9;
    let mut random = Normal::new(9);
    let mut line = Recursive::new(&assumptions(None), forgetting).expect("in range");
    let mut sums = [0.0; 5];
    for _ in 0..40 {
        let seen = noisy(&seen(&table_1_sand(), random.even(0.1, 0.6), random.even(40.0, 90.0)), &mut random);
        line.add(&kapvik_wheel(), &seen).expect("taken up");
        // κ₁ and κ₂ of one point: the line through it with c held at 0 and at 1 kPa.
        let slope = |cohesion_pa| {
            let told = iagnemma(&kapvik_wheel(), &[seen], &assumptions(Some(cohesion_pa))).expect("an answer");
            told.friction_angle_rad.value.tan()
        };
        let (through_0, through_1000) = (slope(0.0), slope(1_000.0));
        let kappa_1 = 1_000.0 / (through_0 - through_1000);
        let kappa_2 = kappa_1 * through_0;
        let parts = [1.0, kappa_1, kappa_2, kappa_1 * kappa_1, kappa_1 * kappa_2];
        sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum = forgetting * *sum + part);
    }
    let [weight, x, y, xx, xy] = sums;
    let slope = (weight * xy - x * y) / (weight * xx - x * x);
    let told = line.identified().expect("an answer");
    assert!((told.friction_angle_rad.value.tan() / slope - 1.0).abs() < 1e-6, "{told:?}, not {slope}");
    assert!((told.cohesion_pa.value - (y - slope * x) / weight).abs() < 0.01, "{told:?}");
}

/// On a new soil the estimate moves over within a few memories; without forgetting it does not.
#[test]
fn it_follows_a_change_of_soil() {
    let weaker = Soil { friction_angle_rad: 0.42, ..table_1_sand() };
    let mut random = Normal::new(12);
    let mut line = |forgetting| {
        let mut line = Recursive::new(&assumptions(Some(0.0)), forgetting).expect("in range");
        let mut end_of = |soil: &Soil<f64>| {
            for _ in 0..150 {
                let seen = averaged(&seen(soil, random.even(0.1, 0.6), random.even(40.0, 90.0)), 100.0);
                line.add(&kapvik_wheel(), &noisy(&seen, &mut random)).expect("taken up");
            }
            line.identified().expect("an answer").friction_angle_rad.value
        };
        [end_of(&table_1_sand()), end_of(&weaker)]
    };
    let [first, forgotten] = line(0.95);
    let [_, remembered] = line(1.0);
    println!("φ {first:.3}, then {forgotten:.3} with forgetting and {remembered:.3} without");
    // Seven and a half memories later nothing is left of the first soil; both are found as far above the truth.
    assert!(((forgotten / first) / (0.42 / table_1_sand().friction_angle_rad) - 1.0).abs() < 0.03);
    assert!((remembered - 0.5 * (first + forgotten)).abs() < 0.02);
}
