//! Training with declared effects: scenes in which they act.

use std::path::Path;

use kapvik_firmware::terramechanics::{sinkage_for_load, wheel_forces};
use kapvik_host::data::campaign::Declared;
use kapvik_host::train::scene::{Design, Scene, scenes, scenes_in};
use kapvik_host::train::world::World;

const KAPVIK: Design = Design::Kapvik { instants: 1, sinkage: true };

fn scenes_with(declared: &str, design: Design, count: usize) -> Vec<Scene> {
    let declared = Declared::parse(Path::new("declared.toml"), declared).unwrap();
    let scenes = scenes_in(&World::declared(&declared), design, count, 3).unwrap();
    assert_eq!(scenes.len(), count);
    assert!(scenes.iter().all(|scene| !scene.wheels.is_empty() && scene.read().len() == scene.wheels.len()));
    scenes
}

fn close(value: f32, expected: f64) -> bool {
    (f64::from(value) - expected).abs() <= 1e-6 * expected.abs() + 1e-9
}

/// n = n₀ + n₁ i is, wheel by wheel, the seed's model on a soil of another exponent.
#[test]
fn slip_sinkage_acts_on_each_wheel_by_its_slip() {
    let text = "[declared]\neffects = [\"slip-sinkage\"]\n[declared.slip-sinkage]\nn1 = 0.4\n";
    for scene in scenes_with(text, Design::Training, 60) {
        for state in &scene.wheels {
            let (slip, load_n) = (f64::from(state.slip), f64::from(state.load_n));
            let mut soil = scene.soil;
            soil.sinkage_exponent += 0.4 * slip;
            let sinkage_m = sinkage_for_load(&scene.wheel, &soil, slip, load_n).unwrap();
            let forces = wheel_forces(&scene.wheel, &soil, slip, sinkage_m).unwrap();
            assert!(
                (f64::from(state.sinkage_m.unwrap()) - sinkage_m).abs() < 1e-5 * sinkage_m,
                "{:?} {sinkage_m}",
                state.sinkage_m
            );
            // A pull is a small difference; slip and load are rounded to single precision here.
            assert!((f64::from(state.drawbar_pull_n) - forces.drawbar_pull_n).abs() < 1e-5 * load_n);
            assert!((f64::from(state.torque_nm) - forces.torque_nm).abs() < 1e-5 * load_n * scene.wheel.radius_m);
        }
    }
}

#[test]
fn sensors_misread_and_the_truth_stays() {
    let text = "[declared]\neffects = [\"force-bias\", \"torque-scale\"]\n[declared.force-bias]\nload_n = 2.0\n\
                [declared.torque-scale]\ngain = 0.1\n";
    let plain = scenes(KAPVIK, 40, 3);
    assert_eq!(plain.len(), 40);
    for (scene, plain) in scenes_with(text, KAPVIK, 40).iter().zip(&plain) {
        assert_eq!(scene.wheels, plain.wheels);
        for (read, truth) in scene.read().iter().zip(&scene.wheels) {
            assert!(close(read.load_n, f64::from(truth.load_n) + 2.0));
            assert!(close(read.torque_nm, 1.1 * f64::from(truth.torque_nm)));
            assert_eq!(read.drawbar_pull_n, truth.drawbar_pull_n);
        }
    }
}

#[test]
fn an_effect_that_no_rover_can_drive_with_is_an_error() {
    let text = "[declared]\neffects = [\"force-bias\"]\n[declared.force-bias]\nload_n = -500.0\n";
    let declared = Declared::parse(Path::new("declared.toml"), text).unwrap();
    let error = scenes_in(&World::declared(&declared), KAPVIK, 10, 3).unwrap_err().to_string();
    assert!(error.contains("force-bias") && error.contains("0 of"), "{error}");
}
