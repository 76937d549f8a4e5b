//! What is learned from: what a side stated at a frame, and how far it erred.

use kapvik_firmware::estimator::doubt::{INPUTS, OUTPUTS};
use kapvik_firmware::estimator::{Believed, SideEstimate, WheelActivity, WheelCovariance, WheelEstimate};
use kapvik_firmware::network::fixed_point::{Quad, SUM_BITS, rounded};
use kapvik_firmware::rover::PerAxle;
use nalgebra::Cholesky;

use crate::data::truth_file::WheelTruth;
use crate::trial::consistency::correlation;
use crate::wheel_quantity::WheelQuantity;

/// A side of a drive, in the order of time: a row for each frame in which the network was run.
pub type SideRows = Vec<Row>;

/// One side of the rover at one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Inputs of the network as it sees them: rounded to 1/4096, within ±8.
    pub inputs: [f32; INPUTS],
    /// How far what was stated was true; none of what is seen only by neurons that remember.
    pub known: Option<Known>,
}

/// What is known of the errors of a side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// Estimate less truth over the stated standard deviation, in the order of the network's outputs; of a side that starts or stops one and a
    /// half times that.
    pub errors: [f32; OUTPUTS],
    /// How the errors of each wheel are stated to belong together.
    pub wheels: PerAxle<Precision>,
}

/// Inverses of a wheel's stated correlations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Precision {
    /// Of filter 1: resistive torque and slip.
    pub torque_slip: [[f32; 2]; 2],
    /// Of filter 2: contact angle, normal load and drawbar pull.
    pub contact: [[f32; 3]; 3],
}

/// Errors of wheels that start or stop count so many times: how loads shift and wheels dig in then is this simulator's own more than what it
/// does with wheels that roll, and another rover's starts are to be within what is stated, too.
const OF_STARTS: f64 = 1.5;

/// Errors of the quantities of a wheel, or their variances, in the order of the network's outputs.
type OfWheel = [f64; OF_WHEEL.len()];

/// What the doubts of a wheel are of, in the order of the network's outputs.
pub(super) const OF_WHEEL: [WheelQuantity; 5] = [
    WheelQuantity::ResistiveTorque,
    WheelQuantity::Slip,
    WheelQuantity::ContactAngle,
    WheelQuantity::NormalLoad,
    WheelQuantity::DrawbarPull,
];

impl Row {
    /// A row of which nothing is known yet.
    pub fn new(inputs: &[f32; INPUTS]) -> Self {
        Self { inputs: seen(inputs), known: None }
    }
}

impl Known {
    /// Of what the filters of a side state, what is estimated, and the truth. None where a number is missing or not finite, where
    /// nothing is stated, or where a wheel is in the air or held fast: what is said of it then does not come from the filters.
    pub fn new(believed: &Believed<f32>, estimate: &SideEstimate, truth: &PerAxle<WheelTruth>) -> Option<Self> {
        let wheels = estimate.wheels.as_ref().zip(truth.as_ref()).zip(believed.wheels.as_ref());
        let counts = if believed.is_steady { 1.0 } else { OF_STARTS };
        let mut errors = [0.0; OUTPUTS];
        let (of_wheels, of_bogie) = errors.as_chunks_mut();
        for (place, ((estimate, truth), stated)) in of_wheels.iter_mut().zip(wheels.into_array()) {
            *place = over_stated(wheel_errors(estimate, truth)?.map(|error| counts * error), variances(stated))?;
        }
        let true_pull_n = truth.middle.drawbar_pull_n + truth.rear.drawbar_pull_n;
        let error_n = f64::from(estimate.bogie_drawbar_pull_n.value) - true_pull_n;
        of_bogie.copy_from_slice(&over_stated([counts * error_n], [f64::from(believed.bogie_pull_variance)])?);
        let PerAxle { front, middle, rear } = believed.wheels.as_ref().map(Precision::new);
        Some(Self { errors, wheels: PerAxle { front: front?, middle: middle?, rear: rear? } })
    }
}

impl Precision {
    /// Of stated covariances; none where one is singular.
    fn new(stated: &WheelCovariance<f32>) -> Option<Self> {
        Some(Self {
            torque_slip: inverse_correlation(&stated.torque_slip)?,
            contact: inverse_correlation(&stated.contact)?,
        })
    }
}

/// The whole numbers that the network would be given, as numbers again.
pub(super) fn seen(inputs: &[f32; INPUTS]) -> [f32; INPUTS] {
    let whole: [Quad; INPUTS / 4] = rounded(inputs, SUM_BITS);
    let mut seen = [0.0; INPUTS];
    let halves = whole.as_flattened().iter().flat_map(|pair| pair.halves());
    seen.iter_mut().zip(halves).for_each(|(place, half)| *place = f32::from(half) / f32::from(1_u16 << SUM_BITS));
    seen
}

fn wheel_errors(estimate: &WheelEstimate, truth: &WheelTruth) -> Option<OfWheel> {
    if matches!(estimate.activity, WheelActivity::Lifted | WheelActivity::Blocked) {
        return None;
    }
    let mut errors = OfWheel::default();
    for (place, quantity) in errors.iter_mut().zip(OF_WHEEL) {
        *place = quantity.error(estimate, truth)?;
    }
    Some(errors)
}

fn variances(stated: &WheelCovariance<f32>) -> OfWheel {
    let [[torque, _], [_, slip]] = stated.torque_slip;
    let [[angle, ..], [_, load, _], [.., pull]] = stated.contact;
    [torque, slip, angle, load, pull].map(f64::from)
}

fn over_stated<const N: usize>(errors: [f64; N], variances: [f64; N]) -> Option<[f32; N]> {
    let mut over = [0.0; N];
    for ((place, error), variance) in over.iter_mut().zip(errors).zip(variances) {
        *place = (error / variance.sqrt()) as f32;
    }
    let stated = variances.iter().all(|variance| *variance > 0.0 && variance.is_finite());
    (stated && over.iter().all(|error| error.is_finite())).then_some(over)
}

fn inverse_correlation<const N: usize>(covariance: &[[f32; N]; N]) -> Option<[[f32; N]; N]> {
    let (_, correlation) = correlation(covariance);
    // Symmetric: that columns are taken for rows does not matter.
    let inverse: [[f64; N]; N] = Cholesky::new(correlation)?.inverse().into();
    let inverse = inverse.map(|line| line.map(|entry| entry as f32));
    inverse.as_flattened().iter().all(|entry| entry.is_finite()).then_some(inverse)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use kapvik_firmware::estimator::Estimate;

    /// As far as the filters' errors belong to each other in a common frame.
    pub fn correlated() -> PerAxle<Precision> {
        let stated = WheelCovariance {
            torque_slip: [[4.0, 0.3], [0.3, 0.25]],
            contact: [[1.0, 0.5, -0.3], [0.5, 4.0, 1.0], [-0.3, 1.0, 9.0]],
        };
        PerAxle::all(Precision::new(&stated).expect("not singular"))
    }

    fn stated() -> Believed<f32> {
        let of_wheel = WheelCovariance {
            torque_slip: [[4.0, 0.0], [0.0, 0.01]],
            contact: [[0.04, 0.0, 0.0], [0.0, 9.0, 4.5], [0.0, 4.5, 9.0]],
        };
        Believed { wheels: PerAxle::all(of_wheel), bogie_pull_variance: 16.0, is_steady: true, inputs: None }
    }

    fn off_by(value: f32) -> Estimate {
        Estimate { value, std: 0.0 }
    }

    fn estimated() -> SideEstimate {
        let wheel = WheelEstimate {
            activity: WheelActivity::Rolling,
            slip: Some(off_by(0.2)),
            resistive_torque_nm: off_by(-2.0),
            contact_angle_rad: off_by(0.1),
            normal_load_n: off_by(6.0),
            drawbar_pull_n: off_by(1.5),
            ..WheelEstimate::default()
        };
        SideEstimate { wheels: PerAxle::all(wheel), bogie_drawbar_pull_n: off_by(-8.0) }
    }

    fn truth() -> PerAxle<WheelTruth> {
        PerAxle::all(WheelTruth { slip: Some(0.0), ..WheelTruth::default() })
    }

    #[test]
    fn errors_are_in_stated_deviations() {
        let known = Known::new(&stated(), &estimated(), &truth()).expect("all is known");
        let expected = [-1.0, 2.0, 0.5, 2.0, 0.5].repeat(3).into_iter().chain([-2.0]);
        assert!(known.errors.iter().zip(expected).all(|(error, expected)| (error - expected).abs() < 1e-6));
        let starting = Known::new(&Believed { is_steady: false, ..stated() }, &estimated(), &truth()).expect("as much");
        let counts = OF_STARTS as f32;
        assert!(starting.errors.iter().zip(known.errors).all(|(starts, rolls)| (starts - counts * rolls).abs() < 1e-6));
        assert!(
            Row::new(&[9.0; INPUTS]).inputs.iter().all(|input| *input == 32_767.0 / 4096.0),
            "inputs saturate as in flight"
        );
        let [_, [_, load, cross], _] = known.wheels.rear.contact;
        assert!((load - 4.0 / 3.0).abs() < 1e-5 && (cross + 2.0 / 3.0).abs() < 1e-5, "{load}, {cross}");
    }

    #[test]
    fn what_the_filters_do_not_say_is_left_out() {
        let mut lifted = estimated();
        lifted.wheels.rear.activity = WheelActivity::Lifted;
        let mut standing = estimated();
        standing.wheels.front.slip = None;
        for estimate in [lifted, standing] {
            assert_eq!(Known::new(&stated(), &estimate, &truth()), None);
        }
        let mut sure = stated();
        sure.bogie_pull_variance = 0.0;
        let mut singular = stated();
        singular.wheels.middle.torque_slip = [[1.0, 1.0], [1.0, 1.0]];
        for stated in [sure, singular] {
            assert_eq!(Known::new(&stated, &estimated(), &truth()), None);
        }
    }
}
