//! Figures published of Ding's identification, six wheels on the seed's sand, computed by an independent implementation
//! that does not state which wheel carried how much: medians and quartiles over draws of the noise.

use kapvik_firmware::identification::Observation;
use kapvik_firmware::identification::ding::{DingBounds, fit};

use super::drawn::{ALTERNATING, Method, Outcome, Published, any_pattern, by_pattern, could_be_one_more, loaded};
use super::made::{Normal, kapvik_wheel};

/// The method without its refusal.
fn within(bounds: DingBounds<f64>) -> impl Method {
    move |wheels: &[Observation<f64>]| fit(&kapvik_wheel(), wheels, &bounds).map(|fit| fit.identified)
}

fn median(figure: f64) -> Published {
    [None, Some(figure), None]
}

fn quartiles(first: f64, median: f64, third: f64) -> Published {
    [first, median, third].map(Some)
}

/// Which of a cell's figures of φ (degrees), K (mm) and c (Pa) could be those of one more pattern of loads.
fn cell(name: &str, outcomes: &[Outcome], [phi, k, c]: [Published; 3]) -> [[bool; 3]; 3] {
    println!("{name}");
    [
        could_be_one_more("  φ", outcomes, |outcome| outcome.friction_deg, phi),
        could_be_one_more("  K", outcomes, |outcome| outcome.modulus_mm, k),
        could_be_one_more("  c", outcomes, |outcome| outcome.cohesion_pa, c),
    ]
}

/// Published: c 695 Pa, φ 30.5°, K 13–14 mm.
#[test]
fn without_noise_at_a_spread_of_8_percent() {
    let mut random = Normal::new(20);
    let patterns: Vec<_> = ALTERNATING.into_iter().chain((0..100).map(|_| any_pattern(&mut random))).collect();
    let told = patterns.iter().map(|pattern| {
        let told = fit(&kapvik_wheel(), &loaded(0.08, pattern), &DingBounds::usual()).expect("an answer").identified;
        [told.cohesion_pa.value, told.friction_angle_rad.value.to_degrees(), 1e3 * told.shear_modulus_m.value]
    });
    let told: Vec<_> = told.collect();
    println!("alternating: {:.1?}", &told[..2]);
    // All three together: a pattern that gives the published c gives the published φ and K.
    let nearest = told.iter().min_by(|a, b| (a[0] - 695.0).abs().total_cmp(&(b[0] - 695.0).abs())).expect("some");
    println!("nearest to 695 Pa: {nearest:.1?}");
    let [c_pa, phi_deg, k_mm] = *nearest;
    assert!(
        (c_pa - 695.0).abs() < 100.0 && (phi_deg - 30.5).abs() < 0.5 && (13.0..14.0).contains(&k_mm),
        "{nearest:?}"
    );
}

#[test]
fn a_hundred_instants_at_a_spread_of_8_percent() {
    let outcomes = by_pattern(0.08, 100.0, &within(DingBounds::usual()));
    let published = [quartiles(27.3, 28.8, 31.9), median(13.2), median(2080.0)];
    assert_eq!(cell("±8 %, 100 instants", &outcomes, published), [[true; 3]; 3]);
}

#[test]
fn one_instant_at_a_spread_of_50_percent() {
    let outcomes = by_pattern(0.5, 1.0, &within(DingBounds::usual()));
    let published = [quartiles(28.1, 30.8, 36.0), median(13.2), [None; 3]];
    assert_eq!(cell("±50 %, one instant", &outcomes, published), [[true; 3]; 3]);
}

/// The medians are found again. Two quartiles are not: the first of φ (31.5°, here at most 31.4°), and the third of c
/// (850 Pa, here at least 1000 Pa), since here a draw in five ends in the other half of the valley of c₁ and c₃, where c is
/// thousands of pascals. With c₃ held at zero there is no such draw, and the published c lies within.
#[test]
fn a_hundred_instants_at_a_spread_of_50_percent() {
    let published = [quartiles(31.5, 31.8, 32.6), median(13.8), quartiles(189.0, 374.0, 850.0)];
    let outcomes = by_pattern(0.5, 100.0, &within(DingBounds::usual()));
    let found = cell("±50 %, 100 instants", &outcomes, published);
    assert_eq!(found, [[false, true, true], [true; 3], [true, true, false]]);
    let outcomes = by_pattern(0.5, 100.0, &within(DingBounds::without_rear_contact()));
    let [_, _, c] = cell("the same, c₃ = 0", &outcomes, published);
    assert_eq!(c, [true; 3]);
}

/// φ 39.6 [26.5, 53.0] cannot come of tan φ ≤ 1.2, the published bound: that ends at 50.2°. It does come of the same steps
/// without bounds on c and φ.
#[test]
fn one_instant_at_a_spread_of_8_percent() {
    let published = [quartiles(26.5, 39.6, 53.0), quartiles(9.4, 14.6, 18.9), [None; 3]];
    let bounded = by_pattern(0.08, 1.0, &within(DingBounds::usual()));
    cell("±8 %, one instant", &bounded, published);
    assert!(bounded.iter().all(|outcome| outcome.friction_deg.third <= 1.2_f64.atan().to_degrees() + 1e-9));
    let free = by_pattern(0.08, 1.0, &within(DingBounds::usual().with_any_strength()));
    assert_eq!(cell("the same, c and φ without bounds", &free, published), [[true; 3]; 3]);
}
