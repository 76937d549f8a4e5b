use super::{AlongLinks, ForceReadings, HubForceFilter};
use crate::rover::{PerAxle, Rover};

const AT_REST_N: f64 = 67.0;

/// What a rover of set K0 feels on the level whose wheels pull nothing, with such a moment of a stop on the bogie, N·m.
fn readings(cells_n: PerAxle<f64>, stop_nm: f64) -> ForceReadings<f64> {
    let suspension = Rover::<f64>::assumed().suspension;
    let bogie = -suspension.middle_hub.x * cells_n.middle - suspension.rear_hub.x * cells_n.rear;
    let rocker = -suspension.front_hub.x * cells_n.front - suspension.bogie_pivot.x * (cells_n.middle + cells_n.rear);
    ForceReadings {
        cells_n: cells_n.map(Some),
        cell_std_n: 0.5,
        bogie_hangs: false,
        all_roll: true,
        bogie_moment_nm: (bogie - stop_nm, 0.07),
        rocker_moment_nm: (rocker + stop_nm, 0.06),
    }
}

/// A filter that has seen such a rover for ten seconds.
fn settled() -> HubForceFilter<f64> {
    let mut filter = HubForceFilter::new(&Rover::assumed(), 0);
    (0..100).for_each(|_| tick(&mut filter, &readings(PerAxle::all(AT_REST_N), 0.0)));
    filter
}

fn tick(filter: &mut HubForceFilter<f64>, readings: &ForceReadings<f64>) {
    let along = AlongLinks { difference_n: 0.0, rocker_n: 0.0, bogie_n: 0.0, are_known: true };
    let _ = filter.tick((0.1, 0.002), 0.0, &along, readings);
}

fn along_links(filter: &HubForceFilter<f64>) -> [f64; 2] {
    let [.., rocker, bogie] = *filter.estimate().mean();
    [rocker, bogie]
}

/// A stop of 6 N·m would be 40 N along bogie and rocker: it is noticed in the frame in which it appears, and the links go on pulling
/// what the torques tell; once it is gone, so is the doubt.
#[test]
fn a_stop_is_not_taken_for_pulls() {
    let mut filter = settled();
    let level = PerAxle::all(AT_REST_N);
    for _ in 0..20 {
        tick(&mut filter, &readings(level, 6.0));
        assert!(filter.bogie_is_held());
        assert!(along_links(&filter).iter().all(|force| force.abs() < 1.0), "{:?}", along_links(&filter));
    }
    tick(&mut filter, &readings(level, 0.0));
    assert!(!filter.bogie_is_held());
}

/// A blocked wheel may make the links bear what no torque knows: no stop is looked for then.
#[test]
fn where_a_wheel_does_not_roll_moments_are_the_soil_s() {
    let mut filter = settled();
    for _ in 0..20 {
        tick(&mut filter, &ForceReadings { all_roll: false, ..readings(PerAxle::all(AT_REST_N), 6.0) });
        assert!(!filter.bogie_is_held());
    }
    assert!(along_links(&filter).iter().all(|force| force.abs() > 20.0), "{:?}", along_links(&filter));
}

/// A wheel that loses 40 N from one frame to the next is followed within three frames, and what it made good is no trend.
#[test]
fn a_load_that_jumps_is_followed() {
    let mut filter = settled();
    let jumped = PerAxle { front: AT_REST_N + 15.0, middle: AT_REST_N - 40.0, rear: AT_REST_N + 25.0 };
    for frame in 0..30 {
        tick(&mut filter, &readings(jumped, 0.0));
        let off = (filter.cells_n().middle - jumped.middle).abs();
        assert!(frame < 3 || off < 2.0, "{frame}: {off}");
    }
}
