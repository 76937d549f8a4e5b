//! The estimators in the flight's single precision against themselves in double precision, on the same frames.

#[path = "../../firmware/tests/support/worse.rs"]
mod worse;

use kapvik_firmware::estimator::{Estimate, RoverEstimator, SideEstimate, SideInnovations, WheelEstimate};
use kapvik_firmware::filter::{Fate, Innovation};
use kapvik_firmware::rover::{PerSide, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::simulate::{Options, Scenario, Traverse};
use kapvik_host::wheel_quantity::WheelQuantity;
use rayon::prelude::*;
use worse::worse;

/// Until then the estimators know next to nothing.
const WARM_UP_US: u64 = 2_000_000;

/// What is published of a wheel or a bogie.
const QUANTITIES: [&str; 6] = ["slip", "torque", "contact angle", "load", "drawbar pull", "bogie's pull"];

fn frames(scenario: Scenario, seed: u64) -> Vec<SensorFrame> {
    let traverse = Traverse::new(scenario, seed, &Rover::assumed(), &Options::default()).expect("a drive");
    traverse.run().expect("frames").into_iter().map(|(frame, _)| frame).collect()
}

/// The difference of two estimates, and that of their standard deviations, over the standard deviation.
fn difference(single: Estimate, double: Estimate) -> [f64; 2] {
    let std = f64::from(double.std);
    [single.value - double.value, single.std - double.std].map(|part| f64::from(part).abs() / std)
}

fn of_wheel(single: &WheelEstimate, double: &WheelEstimate) -> [[f64; 2]; 5] {
    assert_eq!(single.activity, double.activity);
    WheelQuantity::ALL.map(|quantity| match (quantity.estimate(single), quantity.estimate(double)) {
        (Some(single), Some(double)) => difference(single, double),
        (None, None) => [0.0; 2],
        _ => [f64::INFINITY; 2],
    })
}

/// Differences of one quantity over a drive, over the standard deviation: of values, and of standard deviations.
#[derive(Debug, Clone, Copy, Default)]
struct Differences {
    greatest: [f64; 2],
    squares: [f64; 2],
    count: f64,
}

impl Differences {
    fn take(&mut self, found: [f64; 2]) {
        for ((greatest, squares), found) in self.greatest.iter_mut().zip(&mut self.squares).zip(found) {
            *greatest = worse(*greatest, found);
            *squares += found * found;
        }
        self.count += 1.0;
    }

    /// Their root mean squares.
    fn rms(&self) -> [f64; 2] {
        self.squares.map(|sum| (sum / self.count).sqrt())
    }
}

/// What became of the measurements of a side.
fn fates<S>(told: &SideInnovations<S>) -> Vec<Fate> {
    fn of<S, const M: usize>(told: &Innovation<S, M>) -> impl Iterator<Item = Fate> {
        told.residuals.iter().map(|residual| residual.fate)
    }
    let wheels = told.wheels.as_array().into_iter().flat_map(of);
    wheels.chain(of(&told.angles)).chain(of(&told.forces)).collect()
}

/// A drive in both precisions.
struct Compared {
    /// In the order of [`QUANTITIES`].
    differences: [Differences; 6],
    /// When a measurement that was at the edge of its gate was first taken in one precision and refused in the other, µs.
    parted_us: Option<u64>,
}

fn compared(scenario: Scenario, seed: u64) -> Compared {
    let rover = Rover::<f32>::assumed();
    let mut single = RoverEstimator::<f32>::new(&rover);
    let mut double = RoverEstimator::<f64>::new(&rover.map(f64::from));
    let mut differences = [Differences::default(); 6];
    let mut parted_us = None;
    for frame in frames(scenario, seed) {
        let _ = (single.tick(&frame), double.tick(&frame));
        if let (None, Some(single), Some(double)) = (parted_us, single.innovations(), double.innovations()) {
            let alike = single.map(fates) == double.map(fates);
            parted_us = (!alike).then_some(frame.time_us);
        }
        if frame.time_us < WARM_UP_US {
            continue;
        }
        let sides: PerSide<(SideEstimate, SideEstimate)> = single.estimate().zip(*double.estimate());
        for (single, double) in sides.as_array() {
            let bogie = difference(single.bogie_drawbar_pull_n, double.bogie_drawbar_pull_n);
            for (single, double) in single.wheels.zip(double.wheels).as_array() {
                let found = of_wheel(single, double).into_iter().chain([bogie]);
                differences.iter_mut().zip(found).for_each(|(differences, found)| differences.take(found));
            }
        }
    }
    for (name, found) in QUANTITIES.into_iter().zip(&differences) {
        let ([of_value, of_std], [most_of_value, most_of_std]) = (found.rms(), found.greatest);
        println!(
            "{scenario:?} {seed}, {name}: values differ by {of_value:.1e} σ, for a moment by {most_of_value:.1e}, \
             standard deviations by {of_std:.1e}, {most_of_std:.1e}"
        );
    }
    if let Some(time_us) = parted_us {
        println!(
            "{scenario:?} {seed}: a measurement at {time_us} µs is taken in one precision and refused in the other"
        );
    }
    Compared { differences, parted_us }
}

/// What is wanted, in standard deviations.
const WANTED: f64 = 1.0e-3;
/// Of some twenty thousand measurements of a drive one in ten million is so near the edge of its gate that rounding decides: in one drive of
/// five hundred. Two of 32 are no chance.
const PARTED: usize = 1;

/// Asks that the differences are as wanted at every moment of sixteen drives of each kind, but where rounding decides what is measured.
fn hold(scenarios: [Scenario; 2]) {
    let drives = (40..56).into_par_iter().flat_map_iter(|seed| scenarios.map(|scenario| (scenario, seed)));
    let parts = |(scenario, seed)| {
        let compared = compared(scenario, seed);
        if compared.parted_us.is_some() {
            return true;
        }
        for (name, found) in QUANTITIES.into_iter().zip(compared.differences) {
            assert!(found.greatest.iter().all(|part| *part <= WANTED), "{scenario:?} {seed}, {name}: {found:?}");
        }
        false
    };
    let parted = drives.filter(|drive| parts(*drive)).count();
    println!("{parted} of 32 drives part at a gate");
    assert!(parted <= PARTED, "{parted} drives part at a gate");
}

#[test]
fn single_precision_is_within_a_thousandth_of_a_standard_deviation_at_every_moment() {
    hold([Scenario::Level, Scenario::Hills]);
}

#[test]
fn so_it_is_on_slopes_and_with_dropouts() {
    hold([Scenario::Slope, Scenario::Dropout]);
}
