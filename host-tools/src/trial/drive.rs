//! One simulated drive through the estimators.

use kapvik_firmware::estimator::WheelEstimate;
use kapvik_firmware::filter::{Fate, Innovation};
use kapvik_firmware::fusion::RoverSoil;
use kapvik_firmware::pipeline::{FrameEstimate, Pipeline};
use kapvik_firmware::rover::Rover;

use super::consistency::{NormalisedSquares, normalised_square};
use super::errors::{Errors, is_front};
use super::flight_pipeline::flight_pipeline;
use super::pulls_seen::PullsSeen;
use super::soil_seen::SoilSeen;
use crate::data::truth_file::{Truth, WheelTruth};
use crate::error::HostError;
use crate::identifiability::bound::Bound;
use crate::replay::naive::{TrailingMean, naive};
use crate::simulate::{Options, Scenario, Traverse};
use crate::wheel_quantity::WheelQuantity;

/// What is compared with the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Slip.
    Slip,
    /// Resistive torque, N·m.
    Torque,
    /// Contact angle, rad.
    ContactAngle,
    /// Normal load, N.
    Load,
    /// Drawbar pull of a front wheel, N.
    FrontPull,
    /// Drawbar pull of a bogie's two wheels together, N.
    BogiePull,
    /// Drawbar pull of one wheel of a bogie, split by torque, N.
    SplitPull,
    /// The same by the seed's rule, in proportion to load, N; it states no standard deviation.
    LoadSplitPull,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Slip,
        Self::Torque,
        Self::ContactAngle,
        Self::Load,
        Self::FrontPull,
        Self::BogiePull,
        Self::SplitPull,
        Self::LoadSplitPull,
    ];

    /// That of a wheel's quantity, the drawbar pull split by torque, of a front wheel or of one of a bogie.
    pub fn of_wheel(quantity: WheelQuantity, is_front: bool) -> Self {
        match quantity {
            WheelQuantity::Slip => Self::Slip,
            WheelQuantity::ResistiveTorque => Self::Torque,
            WheelQuantity::ContactAngle => Self::ContactAngle,
            WheelQuantity::NormalLoad => Self::Load,
            WheelQuantity::DrawbarPull if is_front => Self::FrontPull,
            WheelQuantity::DrawbarPull => Self::SplitPull,
        }
    }

    /// What is estimated of a wheel there.
    pub const fn kind(self) -> WheelQuantity {
        match self {
            Self::Slip => WheelQuantity::Slip,
            Self::Torque => WheelQuantity::ResistiveTorque,
            Self::ContactAngle => WheelQuantity::ContactAngle,
            Self::Load => WheelQuantity::NormalLoad,
            Self::FrontPull | Self::BogiePull | Self::SplitPull | Self::LoadSplitPull => WheelQuantity::DrawbarPull,
        }
    }

    /// Its name for people, the wheels that it is of behind it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::FrontPull => "drawbar pull, front wheels",
            Self::BogiePull => "drawbar pull, both wheels of a bogie",
            Self::SplitPull => "… of one of them, split by torque",
            Self::LoadSplitPull => "… split by load",
            Self::Slip | Self::Torque | Self::ContactAngle | Self::Load => self.kind().name(),
        }
    }

    /// Whether its estimate comes with a standard deviation.
    pub fn states_std(self) -> bool {
        self != Self::LoadSplitPull
    }
}

/// What a drive came to.
#[derive(Debug, Clone, Default)]
pub struct Drive {
    /// Errors.
    pub errors: Errors,
    /// Squared errors of filter 1: torque and slip of each wheel.
    pub filter_1: NormalisedSquares,
    /// Squared errors of filter 2: contact angle, load and drawbar pull of each front wheel.
    pub filter_2: NormalisedSquares,
    /// Squared innovations of filter 1, of the two halves of filter 2.
    pub innovations: [NormalisedSquares; 3],
    /// Normalised innovations of each measurement, a series each: filter 1 of one wheel, then both halves of filter 2 of one
    /// side.
    pub series: [Vec<f64>; 12],
    /// Where the errors of the pulls come from, and the bounds on them.
    pub pulls: PullsSeen,
    /// The soil, frame by frame, from the first estimate on.
    pub soils: Vec<SoilPoint>,
    /// The bound on what any estimator could say of the soil at [`SOIL_LOOK_S`].
    pub soil_bound: Option<Bound>,
}

/// What was said of the soil at a frame, and what it was.
#[derive(Debug, Clone, Copy)]
pub struct SoilPoint {
    /// What was said.
    pub said: RoverSoil,
    /// What is true.
    pub truth: Truth,
}

/// Seconds at the start that are not counted: the estimators know nothing yet, and the rover stands.
pub const WARM_UP_S: f64 = 5.0;

/// Seconds after the first frame at which the soil is looked at: the rovers start at 1 s.
pub const SOIL_LOOK_S: f64 = 31.0;
/// Frames that count as alike for the bound on the soil: those of a second.
const ALIKE: usize = 10;

impl Drive {
    /// Drives a scenario.
    ///
    /// # Errors
    /// Where the simulation fails.
    pub fn run(scenario: Scenario, seed: u64, rover: &Rover<f64>, options: &Options) -> Result<Self, HostError> {
        let failed = |why: String| scenario.failed(seed, why);
        let mut traverse = Traverse::new(scenario, seed, rover, options).map_err(|error| failed(error.to_string()))?;
        let mut pipeline = flight_pipeline(rover).map_err(failed)?;
        let (mut drive, mut trailing) = (Self::default(), TrailingMean::default());
        let mut seen = SoilSeen::default();
        for index in 0.. {
            let Some(step) = traverse.next() else { break };
            let (frame, truth) = step.map_err(|error| failed(error.to_string()))?;
            let estimate = *pipeline.tick(&frame);
            let now = naive(rover, &frame);
            let second = trailing.push(frame.time_us, now);
            drive.soils.extend(estimate.soil.ok().map(|said| SoilPoint { said, truth }));
            let time_s = frame.time_us as f64 * 1.0e-6;
            if time_s < SOIL_LOOK_S && index % ALIKE == ALIKE / 2 {
                seen.take(traverse.world(), traverse.instant(), &truth, ALIKE as f64);
            }
            let speed_m_s = traverse.instant().motion.rates.x;
            drive.pulls.take(rover, speed_m_s, &estimate, &truth, time_s >= WARM_UP_S);
            if time_s >= WARM_UP_S {
                drive.errors.take(&estimate, &now, &second, &truth);
                drive.take_squares(index, &pipeline, &estimate, &truth);
            }
        }
        drive.soil_bound = seen.bound();
        Ok(drive)
    }

    fn take_squares(&mut self, index: usize, pipeline: &Pipeline, estimate: &FrameEstimate, truth: &Truth) {
        let estimator = pipeline.estimator();
        let (Some(covariances), Some(innovations)) = (estimator.covariances(), estimator.innovations()) else { return };
        let wheels = estimate.wheels.zip_wheels(covariances).zip_wheels(truth.wheels);
        for (place, ((wheel, covariance), truth)) in wheels.iter_wheels().enumerate() {
            let of_filter_1 = errors([WheelQuantity::ResistiveTorque, WheelQuantity::Slip], wheel, truth);
            if let Some(square) = of_filter_1.and_then(|errors| normalised_square(errors, &covariance.torque_slip)) {
                self.filter_1.add(index, place, square, 2.0);
            }
            let of_contact = [WheelQuantity::ContactAngle, WheelQuantity::NormalLoad, WheelQuantity::DrawbarPull];
            let of_filter_2 = errors(of_contact, wheel, truth).filter(|_| is_front(place));
            if let Some(square) = of_filter_2.and_then(|errors| normalised_square(errors, &covariance.contact)) {
                self.filter_2.add(index, place, square, 3.0);
            }
        }
        let [of_wheels, of_angles, of_forces] = &mut self.innovations;
        for (at, side) in innovations.as_array().into_iter().enumerate() {
            for (axle, wheel) in side.wheels.as_array().into_iter().enumerate() {
                add_innovation(of_wheels, (index, 3 * at + axle), wheel);
            }
            add_innovation(of_angles, (index, at), &side.angles);
            add_innovation(of_forces, (index, at), &side.forces);
        }
        let side = innovations.left;
        let residuals = side.wheels.front.residuals.iter().chain(&side.angles.residuals).chain(&side.forces.residuals);
        for (series, residual) in self.series.iter_mut().zip(residuals) {
            series.extend(residual.normalised().map(f64::from));
        }
    }
}

/// Errors of some quantities; none where one of them has none.
fn errors<const N: usize>(
    quantities: [WheelQuantity; N],
    wheel: &WheelEstimate,
    truth: &WheelTruth,
) -> Option<[f64; N]> {
    let errors = quantities.map(|quantity| quantity.error(wheel, truth));
    errors.iter().all(Option::is_some).then(|| errors.map(Option::unwrap_or_default))
}

fn add_innovation<const M: usize>(
    squares: &mut NormalisedSquares,
    (frame, place): (usize, usize),
    told: &Innovation<f32, M>,
) {
    if told.residuals.iter().any(|residual| residual.fate == Fate::Used) {
        squares.add(frame, place, f64::from(told.normalised_square), told.degrees_of_freedom as f64);
    }
}
