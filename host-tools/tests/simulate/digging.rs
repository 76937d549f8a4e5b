//! Slip-sinkage on a rover: it follows with the way, so that a start, where slip passes through one, digs nobody in.

use kapvik_firmware::rover::{PerWheel, Rover};
use kapvik_firmware::terramechanics::{Soil, sinkage_for_load, wheel_forces};
use kapvik_host::data::truth_file::Truth;
use kapvik_host::simulate::balance::WheelInstant;
use kapvik_host::simulate::effects::RoverEffects;
use kapvik_host::simulate::{Options, Scenario, Traverse};

use super::worse::worse;
use super::{drive, quiet_rover};

/// n₁ of Mars simulants is 0.35 to 0.45, of the seed's sand about 0.3.
const N1: f64 = 0.3;

fn with_slip_sinkage() -> Options {
    let effects = RoverEffects::only("slip-sinkage", N1).expect("an effect of rovers");
    Options { effects, ..Options::default() }
}

fn last(rows: &[(kapvik_firmware::sensor_frame::SensorFrame, Truth)]) -> Truth {
    rows.last().expect("a frame").1
}

/// A soil after so much slip.
fn dug(soil: &Soil<f64>, slip: f64) -> Soil<f64> {
    Soil { sinkage_exponent: soil.sinkage_exponent + N1 * slip, ..*soil }
}

/// Before the sinkage followed the way, eight of these twenty found no balance as they started.
#[test]
fn rovers_start_on_soil_that_sinks_with_slip() {
    let options = with_slip_sinkage();
    let ways_m: Vec<f64> = (1..=20)
        .map(|seed| Traverse::new(Scenario::Level, seed, &quiet_rover(), &options).and_then(Traverse::run))
        .map(|rows| rows.map_or(0.0, |rows| last(&rows).x_m))
        .collect();
    println!("ways in m: {ways_m:.2?}");
    // 58 s at 0.021 … 0.028 m/s and a slip of at most a half.
    assert!(ways_m.iter().filter(|way| **way > 0.6).count() >= 19, "{ways_m:?}");
}

/// The forces are those of the soil that has felt so much slip, and that slip is the one that an integration of
/// ds/dx = (|i| − s)/L finds frame by frame, by the trapezoidal rule.
#[test]
fn the_soil_feels_the_slip_over_the_length_of_the_contact() {
    let mut traverse = Traverse::new(Scenario::Spread, 6, &quiet_rover(), &with_slip_sinkage()).expect("a drive");
    let wheel = quiet_rover().wheel;
    let rate = |wheel: &WheelInstant, felt: f64| {
        let motion = wheel.motion;
        let fastest = motion.rim_speed_m_s.max(motion.hub_speed_m_s);
        let length_m = 0.075 * (1.0 - motion.sinkage_m / 0.075).acos().sin();
        motion.slip().map_or(0.0, |slip| (slip.abs() - felt) * fastest / length_m)
    };
    let mut felt = PerWheel::<f64>::default();
    let mut before = *traverse.instant();
    let mut most: f64 = 0.0;
    while let Some(row) = traverse.next() {
        row.expect("a frame");
        let (instant, world) = (traverse.instant(), traverse.world());
        let wheels = instant.wheels.iter_wheels().zip(before.wheels.iter_wheels());
        for ((found, expected), (now, last)) in
            instant.motion.felt_slip.iter_wheels().zip(felt.iter_wheels_mut()).zip(wheels)
        {
            let guess = *expected + 0.1 * rate(last, *expected);
            *expected += 0.05 * (rate(last, *expected) + rate(now, guess));
            most = worse(most, (found - *expected).abs());
            if let Some(slip) = now.motion.slip().filter(|_| now.motion.rim_speed_m_s > 0.01) {
                let soil = dug(&world.soils.at(0.0), *found);
                let forces = wheel_forces(&wheel, &soil, slip, now.motion.sinkage_m).expect("in range");
                assert!((now.forces.drawbar_pull_n - forces.drawbar_pull_n).abs() < 1e-9);
                assert!((now.forces.torque_nm - forces.torque_nm).abs() < 1e-9);
            }
        }
        before = *instant;
    }
    println!("felt slip: at most {most:.4} from the integration");
    assert!(most < 0.02, "{most}");
}

/// On the level, with slips that are spread.
#[test]
fn sinkage_grows_with_slip() {
    for seed in 4..8 {
        let [with, without] =
            [with_slip_sinkage(), Options::default()].map(|options| drive(Scenario::Spread, seed, &options));
        let (with, without) = (last(&with), last(&without));
        let mut wheels: Vec<(f64, f64)> = with
            .wheels
            .iter_wheels()
            .zip(without.wheels.iter_wheels())
            .map(|(with, without)| (with.slip.expect("it moves"), with.sinkage_m / without.sinkage_m))
            .collect();
        wheels.sort_by(|a, b| a.0.total_cmp(&b.0));
        println!("{seed}: slip, sinkage over that without: {wheels:.2?}");
        // Wheels that slip alike may differ by their loads.
        let apart = |pair: &&[(f64, f64)]| pair[1].0 - pair[0].0 > 0.02;
        assert!(wheels.windows(2).filter(apart).all(|pair| pair[0].1 < pair[1].1), "{seed}: {wheels:?}");
        assert!(wheels[5].0 > 0.5 && wheels[5].1 > 1.3, "{seed}: {wheels:?}");
    }
}

/// A blocked front wheel holds the rover, and the others spin on the spot: they end as deep as the soil that has felt a slip
/// of one lets them, and come out again.
#[test]
fn wheels_that_spin_on_the_spot_dig_in() {
    let rows = drive(Scenario::WheelBlocked, 41, &with_slip_sinkage());
    let mut traverse =
        Traverse::new(Scenario::WheelBlocked, 41, &quiet_rover(), &with_slip_sinkage()).expect("a drive");
    let soil = traverse.world().soils.at(0.0);
    assert!(traverse.by_ref().take(1).all(|row| row.is_ok()));
    let deep = |time: usize| rows[time].1.wheels.left.middle;
    let wheel = Rover::<f64>::assumed().wheel;
    let spinning = deep(300);
    assert!(spinning.slip.is_some_and(|slip| slip > 0.98), "{spinning:?}");
    let load_n = spinning.normal_load_n;
    let [fresh, felt] = [0.0, 1.0].map(|slip| sinkage_for_load(&wheel, &dug(&soil, slip), 1.0, load_n).expect("held"));
    println!("sunk {:.1} mm; fresh soil {:.1} mm, dug {:.1} mm", 1e3 * spinning.sinkage_m, 1e3 * fresh, 1e3 * felt);
    assert!(felt > 2.0 * fresh && (spinning.sinkage_m / felt - 1.0).abs() < 0.05);
    assert!((deep(590).sinkage_m / deep(140).sinkage_m - 1.0).abs() < 0.05, "out of its hole again");
}
