//! Ding's decoupled identification.
use kapvik_firmware::identification::ding::{DingBounds, ding, fit};

use super::drawn::{ALTERNATING, Quartiles, any_pattern, loaded, outcome};
use super::made::{Normal, kapvik_wheel, six_wheels, table_1_sand};

#[test]
fn scratch() {
    let wheel = kapvik_wheel();
    for p in &ALTERNATING {
        for s in [0.08, 0.5] {
            let f = fit(&wheel, &loaded(s, p), &DingBounds::usual()).unwrap();
            println!("{s} {p:?}: {f:#?}");
        }
    }
    println!("equal {:#?}", fit(&wheel, &six_wheels(&table_1_sand()), &DingBounds::usual()));
    let mut rnd = Normal::new(1);
    let v: Vec<_> = (0..400)
        .map(|_| fit(&wheel, &loaded(0.08, &any_pattern(&mut rnd)), &DingBounds::usual()).unwrap().identified)
        .collect();
    println!(
        "random noise-free c {} phi {} K {}",
        Quartiles::of(v.iter().map(|i| i.cohesion_pa.value).collect()),
        Quartiles::of(v.iter().map(|i| i.friction_angle_rad.value.to_degrees()).collect()),
        Quartiles::of(v.iter().map(|i| 1e3 * i.shear_modulus_m.value).collect())
    );
    for (bn, bounds) in [
        ("usual", DingBounds::usual()),
        ("c3=0", DingBounds::without_rear_contact()),
        ("any", DingBounds::usual().with_any_strength()),
        ("any c3=0", DingBounds::without_rear_contact().with_any_strength()),
    ] {
        for spread in [0.0, 0.08, 0.5] {
            for inst in [1.0, 100.0] {
                for (pn, p) in [("alt-", Some(&ALTERNATING[0])), ("alt+", Some(&ALTERNATING[1])), ("rand", None)] {
                    println!(
                        "{bn} {spread} {inst} {pn} fit : {}",
                        outcome(spread, p, inst, |o| fit(&wheel, o, &bounds).map(|f| f.identified))
                    );
                    println!(
                        "{bn} {spread} {inst} {pn} ding: {}",
                        outcome(spread, p, inst, |o| ding(&wheel, o, &bounds))
                    );
                }
            }
        }
    }
}
