//! The sinkage that carries a load.

use kapvik_firmware::terramechanics::{
    SinkageError, Soil, deepest_sinkage, greatest_load, sinkage_for_load, wheel_forces,
};

use super::{forces, kapvik_wheel, table_1_sand};

fn soils() -> [Soil<f64>; 5] {
    let sand = table_1_sand();
    [
        sand,
        Soil { sinkage_exponent: 0.3, frictional_modulus: 200e3, cohesion_pa: 14e3, ..sand },
        Soil { sinkage_exponent: 1.7, frictional_modulus: 3e6, shear_modulus_m: 0.0005, ..sand },
        Soil { sinkage_exponent: 0.11, frictional_modulus: 100e3, rebound_ratio: 0.5, ..sand },
        Soil { friction_angle_rad: 0.8, rebound_ratio: 0.2, ..sand },
    ]
}

#[test]
fn the_load_is_met() {
    let wheel = kapvik_wheel();
    for soil in soils() {
        for slip in [-1.0, -0.6, -0.1, 0.0, 0.2, 0.9, 1.0] {
            for share in [1e-3, 0.1, 0.5, 0.9, 0.999_999] {
                let load_n = share * greatest_load(&wheel, &soil, slip).expect("valid").load_n;
                let z = sinkage_for_load(&wheel, &soil, slip, load_n).expect("carried");
                let met = forces(&wheel, &soil, slip, z).load_n;
                assert!((met / load_n - 1.0).abs() < 1e-10, "{soil:?} {slip} {share}: {met} of {load_n}");
            }
        }
    }
}

/// The first crossing on a fine grid is the one that is found.
#[test]
fn the_smallest_sinkage_is_found() {
    const GRID: u32 = 2000;
    let wheel = kapvik_wheel();
    for soil in soils() {
        for slip in [-0.9, -0.3, 0.3] {
            let load_n = 0.8 * greatest_load(&wheel, &soil, slip).expect("valid").load_n;
            let at = |k: u32| deepest_sinkage(&wheel) * f64::from(k) / f64::from(GRID);
            let first = (1..=GRID).find(|&k| forces(&wheel, &soil, slip, at(k)).load_n >= load_n).expect("carried");
            let z = sinkage_for_load(&wheel, &soil, slip, load_n).expect("carried");
            assert!(
                z > at(first - 1) && z <= at(first),
                "{soil:?} {slip}: {z} not in {} … {}",
                at(first - 1),
                at(first)
            );
        }
    }
}

#[test]
fn single_precision_meets_the_load_too() {
    let wheel = kapvik_wheel().map(|length| length as f32);
    let soil = table_1_sand().map(|value| value as f32);
    for slip in [-0.5_f32, 0.0, 0.1, 0.3, 0.9] {
        for load_n in [0.5_f32, 5.0, 65.4, 400.0] {
            let z = sinkage_for_load(&wheel, &soil, slip, load_n).expect("carried");
            let met = wheel_forces(&wheel, &soil, slip, z).expect("in range").load_n;
            assert!((met / load_n - 1.0).abs() < 1e-5, "{slip} {load_n}: {met}");
        }
    }
}

#[test]
fn a_load_that_is_too_great_is_said_to_be() {
    for slip in [-0.5, 0.2] {
        let most = greatest_load(&kapvik_wheel(), &table_1_sand(), slip).expect("valid");
        let found = sinkage_for_load(&kapvik_wheel(), &table_1_sand(), slip, 1.0001 * most.load_n);
        assert_eq!(found, Err(SinkageError::LoadTooGreat));
        assert!(most.sinkage_m <= deepest_sinkage(&kapvik_wheel()));
    }
}

#[test]
fn a_load_must_be_a_number_above_zero() {
    for load_n in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(sinkage_for_load(&kapvik_wheel(), &table_1_sand(), 0.2, load_n), Err(SinkageError::Input));
    }
    assert_eq!(sinkage_for_load(&kapvik_wheel(), &table_1_sand(), 1.5, 10.0), Err(SinkageError::Input));
}
