//! How well torques tell the way two wheels of a bogie share their drawbar pull, over the soils of the prior.

use kapvik_firmware::estimator::drawbar_split::{BogieWheel, DrawbarSplit};
use kapvik_firmware::terramechanics::{sinkage_for_load, wheel_forces};
use kapvik_firmware::wheel_state::WheelState;
use kapvik_host::prior::{DEEPEST, KAPVIK_WHEEL, any_soil};
use kapvik_host::train::scene::{Design, Scene, scenes};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn wheel(scene: &Scene, state: &WheelState) -> BogieWheel<f64> {
    BogieWheel {
        load_n: f64::from(state.load_n),
        rim_force_n: f64::from(state.torque_nm) / scene.wheel.radius_m,
        slip: f64::from(state.slip),
        direction: 1.0,
    }
}

/// Root mean square errors of the difference by torque and by load, and of the first in its stated standard deviations.
fn errors(pairs: &[(usize, usize)]) -> [f64; 3] {
    let scenes = scenes(Design::Kapvik { instants: 1, sinkage: false }, 2000, 77);
    let mut sums = [0.0; 3];
    for scene in &scenes {
        for (middle, rear) in pairs {
            let (middle, rear) = (&scene.wheels[*middle], &scene.wheels[*rear]);
            let (pull, other) = (f64::from(middle.drawbar_pull_n), f64::from(rear.drawbar_pull_n));
            let split = DrawbarSplit::by_torque(&wheel(scene, middle), &wheel(scene, rear), pull + other);
            let by_load = DrawbarSplit::by_load_n(f64::from(middle.load_n), f64::from(rear.load_n), pull + other);
            let error = split.difference_n - (pull - other);
            let squares = [error, by_load - (pull - other), error / split.std_n].map(|error| error * error);
            sums.iter_mut().zip(squares).for_each(|(sum, square)| *sum += square);
        }
    }
    sums.map(|sum: f64| (sum / (scenes.len() * pairs.len()) as f64).sqrt())
}

/// Wheels at slips between 0.05 and 0.6: 12 000 pairs on 2 000 soils.
#[test]
fn the_split_by_torque_is_as_good_as_it_states_and_far_better_than_the_split_by_load() {
    let pairs = [(0, 1), (1, 2), (2, 3), (0, 3), (1, 4), (5, 0)];
    let [by_torque, by_load, normalised] = errors(&pairs);
    println!("by torque {by_torque:.2} N, by load {by_load:.2} N, {normalised:.2} stated standard deviations");
    assert!(by_torque < 0.2 * by_load, "{by_torque} {by_load}");
    assert!((0.7..=1.3).contains(&normalised), "{normalised}");
}

/// A bogie whose pivot is not in its middle: one wheel bears up to four times as much as the other.
#[test]
fn the_split_states_its_errors_where_one_wheel_bears_far_more_than_the_other() {
    const MEAN_LOAD_N: f64 = 65.0;
    let mut random = ChaCha8Rng::seed_from_u64(91);
    for unevenness in [0.3, 0.6, 0.9, 1.2] {
        let mut squares = Vec::new();
        for _ in 0..1000 {
            let soil = any_soil(|| random.random());
            let slips = [0, 1].map(|_| random.random_range(0.03..0.5));
            let loads_n = [1.0, -1.0].map(|sign| MEAN_LOAD_N * (1.0 + 0.5 * sign * unevenness));
            let wheel = |place: usize| {
                let (load_n, slip) = (loads_n[place], slips[place]);
                let sinkage_m = sinkage_for_load(&KAPVIK_WHEEL, &soil, slip, load_n).ok()?;
                let forces = wheel_forces(&KAPVIK_WHEEL, &soil, slip, sinkage_m).ok()?;
                let rim_force_n = forces.torque_nm / KAPVIK_WHEEL.radius_m;
                let carries = sinkage_m <= DEEPEST * KAPVIK_WHEEL.radius_m;
                let wheel = BogieWheel { load_n, rim_force_n, slip, direction: 1.0 };
                carries.then_some((wheel, forces.drawbar_pull_n))
            };
            let Some(((middle, pull_n), (rear, other_n))) = wheel(0).zip(wheel(1)) else { continue };
            let split = DrawbarSplit::by_torque(&middle, &rear, pull_n + other_n);
            squares.push(((split.difference_n - (pull_n - other_n)) / split.std_n).powi(2));
        }
        let normalised = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        println!("ΔW/W̄ {unevenness}: {normalised:.2} stated standard deviations, {} pairs", squares.len());
        assert!(squares.len() > 800 && (0.5..=1.3).contains(&normalised), "{unevenness}: {normalised}");
    }
}

/// A bogie that backs up: pull and torque are those of the mirror image, whatever each wheel bears.
#[test]
fn wheels_that_back_up_split_their_pull_as_their_mirror_image_does() {
    let wheel = |load_n, rim_force_n, slip| BogieWheel { load_n, rim_force_n, slip, direction: 1.0 };
    for (middle, rear, sum_n) in [
        (wheel(100.0, 22.0, 0.3), wheel(40.0, 9.0, 0.1), 8.0),
        (wheel(65.0, 12.0, -0.1), wheel(66.0, 18.0, 0.2), -4.0),
        (wheel(20.0, 3.0, 0.05), wheel(120.0, 30.0, 0.4), 15.0),
    ] {
        let back = |wheel: &BogieWheel<f64>| BogieWheel { rim_force_n: -wheel.rim_force_n, direction: -1.0, ..*wheel };
        let forward = DrawbarSplit::by_torque(&middle, &rear, sum_n);
        let backward = DrawbarSplit::by_torque(&back(&middle), &back(&rear), -sum_n);
        assert!((forward.difference_n + backward.difference_n).abs() < 1e-12, "{forward:?}, {backward:?}");
        assert_eq!(forward.std_n, backward.std_n);
    }
}

/// Errors of filter 2 may make a load negative.
#[test]
fn wheels_whose_loads_sum_to_nothing_have_a_split() {
    let wheel = |load_n: f32| BogieWheel { load_n, rim_force_n: 3.0, slip: 0.2, direction: 1.0 };
    for sinking in [0.0, 0.04] {
        for pair @ (middle, rear) in [(&wheel(0.0), &wheel(0.0)), (&wheel(5.0), &wheel(-5.0))] {
            let split = DrawbarSplit::by_torque(middle, rear, 1.0).while_digging(pair, 1.0, sinking);
            assert!(split.difference_n.is_finite() && split.std_n.is_finite(), "{sinking}: {split:?}");
        }
    }
}
