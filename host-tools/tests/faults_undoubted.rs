//! Sensors that fail for some time, of which the filters are told nothing: no healthy sensor is doubted for it, and what is wrong all along
//! is told as if nothing had failed.

use kapvik_firmware::rover::Rover;
use kapvik_host::replay::Doubts;
use kapvik_host::simulate::faults::{Failure, Fault};
use kapvik_host::simulate::{Options, Scenario, Traverse};
use rayon::prelude::*;

/// What is doubted of a drive with a fault, of a rover of which the mass is stated, kg.
fn doubted(scenario: Scenario, seed: u64, mass_kg: f64, (failure, columns, between_s): FaultOf) -> Vec<String> {
    let rover = Rover::assumed();
    let fault = Fault::new(failure, columns, between_s).expect("a fault");
    let options = Options { faults: vec![fault], ..Options::default() };
    let mut doubts = Doubts::of(&Rover { mass_kg, ..rover }.map(|value| value as f32));
    for step in Traverse::new(scenario, seed, &rover, &options).expect("a drive") {
        doubts.take(&step.expect("a frame").0);
    }
    doubts.told()
}

/// How which columns fail from when to when, s.
type FaultOf = (Failure, &'static str, (f64, f64));

const MASS_KG: f64 = 41.0;

#[test]
fn a_failure_is_no_doubt_of_healthy_sensors() {
    use Failure::{Infinity, Nan, Outlier, Stuck, Zero};
    let long_s = (15.0, 80.0);
    let drives = [
        (Scenario::StartStop, 1, (Outlier, "gyro_z_rad_s", (20.0, 20.2))),
        (Scenario::Hills, 3, (Outlier, "velocity_x_m_s", (35.0, 35.0))),
        (Scenario::Hills, 4, (Outlier, "velocity_z_m_s", (35.0, 35.5))),
        (Scenario::Level, 1, (Outlier, "load_cell_fl_n", (10.0, 60.0))),
        (Scenario::Hills, 4, (Outlier, "bogie_angle_l_rad", long_s)),
        (Scenario::Hills, 4, (Stuck, "gyro_y_rad_s", long_s)),
        (Scenario::Hills, 4, (Stuck, "rocker_angle_rad", long_s)),
        (Scenario::Hills, 4, (Zero, "load_cell_ml_n", long_s)),
        (Scenario::Hills, 4, (Nan, "accel_x_m_s2", long_s)),
        (Scenario::Hills, 4, (Infinity, "motor_torque_fr_nm", long_s)),
    ];
    drives.into_par_iter().for_each(|(scenario, seed, fault)| {
        let told = doubted(scenario, seed, MASS_KG, fault);
        assert!(told.is_empty(), "{scenario:?}, seed {seed}, {fault:?}: {told:?}");
    });
}

/// An accelerometer that is broken for most of a drive is told by itself, for its readings are no gravity.
#[test]
fn a_broken_accelerometer_turns_no_joint() {
    let told = doubted(Scenario::Hills, 4, MASS_KG, (Failure::Outlier, "accel_z_m_s2", (15.0, 80.0)));
    assert!(told.len() == 1 && told[0].starts_with("the accelerometer feels"), "{told:?}");
}

#[test]
fn what_is_wrong_all_along_is_told_in_spite_of_a_failure() {
    for between_s in [(40.0, 40.0), (40.0, 45.0)] {
        let told = doubted(Scenario::Hills, 4, 60.0, (Failure::Outlier, "load_cell_fl_n", between_s));
        assert!(told.len() == 1 && told[0].starts_with("the load cells together bear"), "{between_s:?}: {told:?}");
    }
}
