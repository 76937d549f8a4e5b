//! Rovers of Kapvik's weight with links of another shape, or with other sensors: what is stated of them has to be true, too.
//!
//! A network that is not told which rover it judges states slips, loads or a bogie's pull of some of them within 2 σ that are so in 85 to
//! 88 % of the frames only.

use kapvik_firmware::rover::{Axes, Planar, Rover, Suspension};
use kapvik_host::simulate::Scenario;
use kapvik_host::trial::{Quantity, trial};

/// The least share of frames within two stated standard deviations: sixteen drives give it to some 1.5 %.
const LEAST_WITHIN_TWO: f64 = 0.9;

/// A long rocker before a short bogie with unequal arms, narrow, its mass high and behind.
fn of_another_shape() -> Rover<f64> {
    let suspension = Suspension {
        front_hub: Planar { x: 0.45, z: -0.25 },
        bogie_pivot: Planar { x: -0.15, z: -0.12 },
        middle_hub: Planar { x: 0.15, z: -0.13 },
        rear_hub: Planar { x: -0.2, z: -0.13 },
        half_track_m: 0.3,
        centre_of_mass: Axes { x: -0.02, y: 0.0, z: 0.12 },
    };
    Rover { suspension, ..Rover::assumed() }
}

/// Load cells four times, and drive torques three times as noisy as Kapvik's are assumed to be.
fn with_noisy_forces() -> Rover<f64> {
    let mut rover = Rover::assumed();
    rover.noise.load_cell_n *= 4.0;
    rover.noise.motor_torque_nm *= 3.0;
    rover
}

fn states_what_is_true(name: &str, rover: &Rover<f64>) {
    for scenario in [Scenario::Level, Scenario::Spread, Scenario::Hills] {
        let trial = trial(scenario, 60..76, rover);
        assert_eq!(trial.drives.len(), 16, "{name}, {scenario}: {:?}", trial.failures);
        let errors = trial.errors();
        for quantity in Quantity::ALL.into_iter().filter(|quantity| quantity.states_std()) {
            let [one, two] = errors.of(quantity).coverage();
            println!("{name}, {scenario}, {}: {one:.2} {two:.3} within", quantity.name());
            assert!(two >= LEAST_WITHIN_TWO, "{name}, {scenario}, {quantity:?}: {two}");
        }
    }
}

#[test]
fn of_a_rover_of_another_shape_what_is_stated_is_true() {
    states_what_is_true("another shape", &of_another_shape());
}

#[test]
fn with_noisier_cells_and_torques_what_is_stated_is_true() {
    states_what_is_true("noisy forces", &with_noisy_forces());
}
