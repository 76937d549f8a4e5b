//! The bank of soils for Ray's method.

#[path = "../../firmware/tests/support/six_slips.rs"]
mod six_slips;

use kapvik_firmware::identification::Observation;
use kapvik_firmware::identification::ray::{BANK, MultipleModel, ray};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::{WheelNoise, WheelState};
use kapvik_host::identify::soil_bank::soil_bank;
use kapvik_host::prior::KAPVIK_WHEEL;
use six_slips::SIX_SLIPS;

/// Six wheels under 65.4 N at slips of 0.05 … 0.60, as the mean of 100 instants has them; none where the soil does not
/// carry them.
fn six_wheels(soil: &Soil<f64>) -> Option<Vec<Observation<f64>>> {
    let noise = WheelNoise { drawbar_pull_n: 0.05, load_n: 0.1, torque_nm: 0.005, slip: 0.001, sinkage_m: 0.0002 };
    let observe = |slip: f64| {
        let state = WheelState::under_load(&KAPVIK_WHEEL, soil, slip, 65.4).ok()?;
        let state = WheelState { sinkage_m: None, ..state };
        Some(Observation { state, noise })
    };
    SIX_SLIPS.into_iter().map(observe).collect()
}

#[test]
fn the_bank_is_the_catalogue_s_whole_soils() {
    let bank = soil_bank().expect("the data file that is built in reads");
    assert_eq!(bank.len(), 39);
    assert!(bank.len() <= BANK);
    let sand = bank.iter().find(|soil| soil.id == "seed-table-1").expect("in the bank");
    assert!(sand.complete);
    assert_eq!(sand.soil.cohesion_pa, 250.0);
}

/// Every soil of the bank that carries the rover is told from all the others, and by its own name.
#[test]
fn each_soil_is_found_in_the_bank() {
    let bank = soil_bank().expect("the data file that is built in reads");
    let soils: Vec<_> = bank.iter().map(|soil| soil.soil).collect();
    let mut carrying = 0;
    for truth in &bank {
        let Some(observed) = six_wheels(&truth.soil) else { continue };
        carrying += 1;
        let mut model = MultipleModel::<_, BANK>::new(&soils).expect("room");
        let found = model.update(&KAPVIK_WHEEL, &observed).expect("an answer");
        let own: f64 = bank
            .iter()
            .zip(model.probabilities())
            .filter(|(soil, _)| soil.soil == truth.soil)
            .map(|(_, probability)| probability)
            .sum();
        assert!(own > 0.9, "{}: {own}, {found:?}", truth.id);
    }
    assert!(carrying >= 20, "{carrying}");
}

/// Without the seed's sand the bank has no soil that explains it, and the method says so.
#[test]
fn the_seed_s_sand_is_missed_where_it_is_not_in_the_bank() {
    let bank = soil_bank().expect("the data file that is built in reads");
    let (with, without): (Vec<_>, Vec<_>) = bank.iter().partition(|soil| soil.id == "seed-table-1");
    let others: Vec<_> = without.iter().map(|soil| soil.soil).collect();
    let found = ray(&KAPVIK_WHEEL, &six_wheels(&with[0].soil).expect("carried"), &others).expect("an answer");
    assert!(!found.friction_angle_rad.identifiable && !found.shear_modulus_m.identifiable);
}
