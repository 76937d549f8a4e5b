//! The catalogue of soils: whole, unique, and converted as stated.

use std::collections::HashSet;

use kapvik_firmware::terramechanics::{Soil, Wheel, sinkage_for_load};
use kapvik_host::soil_catalogue::{CatalogueSoil, Completion, Incomplete, TABLE_1, catalogue};

fn soils() -> Vec<CatalogueSoil> {
    catalogue().expect("the data file that is built in reads")
}

fn soil(id: &str) -> CatalogueSoil {
    soils().into_iter().find(|soil| soil.id == id).expect("in the catalogue")
}

#[test]
fn every_row_has_a_name_a_source_and_an_id_of_its_own() {
    let ids: HashSet<String> = soils().into_iter().map(|soil| soil.id).collect();
    assert_eq!(ids.len(), soils().len());
    assert!(soils().iter().all(|soil| !soil.name.is_empty() && soil.source.len() > 10));
}

#[test]
fn what_is_assumed_is_there() {
    const KEYS: [&str; 9] = ["n", "k_c", "k_phi", "c", "phi", "K", "c1", "c2", "eta"];
    for soil in soils() {
        for key in &soil.assumed {
            assert!(KEYS.contains(&key.as_str()), "{}: {key}", soil.id);
        }
        assert!(!soil.assumed.iter().any(|key| key == "K") || soil.shear_modulus_mm.is_some(), "{}", soil.id);
    }
}

#[test]
fn the_seed_s_sand_is_in_si() {
    let sand = soil("seed-table-1").complete(&Completion::SEED).expect("complete");
    assert_eq!([sand.sinkage_exponent, sand.cohesive_modulus, sand.frictional_modulus], [1.1, 15_600.0, 2_407_400.0]);
    assert_eq!(
        [sand.cohesion_pa, sand.peak_stress_c1, sand.peak_stress_c2, sand.rebound_ratio],
        [250.0, 0.18, 0.32, 0.0]
    );
    assert!((sand.friction_angle_rad - 0.556_760_031_386_191_1).abs() < 1e-12);
    assert!((sand.shear_modulus_m - 0.0114).abs() < 1e-15);
    let rounded = |soil: &Soil<f64>| soil.map(|number| number as f32);
    assert_eq!(rounded(&sand), rounded(&TABLE_1), "what the tools take for Table 1");
}

/// Under the wheel that they were used with, Bekker's moduli give Reece's pressure: (k₁ + k₂ b)(z/b)ⁿ.
#[test]
fn reece_s_moduli_give_the_same_pressure() {
    let sand = soil("wong-reece-compact-sand").complete(&Completion::SEED).expect("complete");
    let (width_m, z) = (0.152, 0.05_f64);
    // 20 lb/in² and 2.5 lb/in³ × 5.984 in, in Pa.
    let reece_pa = (137_895.146 + 678_618.8 * width_m) * (z / width_m).powf(0.47);
    let bekker_pa = sand.stiffness(width_m) * z.powf(0.47);
    assert!((bekker_pa / reece_pa - 1.0).abs() < 1e-6, "{bekker_pa} {reece_pa}");
}

#[test]
fn what_is_missing_is_said() {
    assert_eq!(soil("mars-sand-simulant").complete(&Completion::SEED), Err(Incomplete::ReeceWithoutWidth));
    assert_eq!(soil("pathfinder-drift").complete(&Completion::SEED), Err(Incomplete::Pressure));
}

/// The soils that are complete are soils: each carries a small wheel under a small load.
#[test]
fn complete_soils_carry() {
    let wheel = Wheel { radius_m: 0.15, width_m: 0.1 };
    let complete: Vec<_> = soils().iter().filter_map(|soil| soil.complete(&Completion::SEED).ok()).collect();
    assert_eq!(complete.len(), 39, "of {} rows", soils().len());
    for soil in complete {
        let z = sinkage_for_load(&wheel, &soil, 0.2, 20.0).expect("carried");
        assert!(z > 0.0 && z < 0.09, "{soil:?}: {z}");
    }
}
