//! The bound against the scatter of estimates from simulated measurements of a manoeuvre.
//!
//! The estimator knows nothing of the bound's code: forces from the f64 equations at a sinkage that is solved for, balances
//! written out for level ground, all slopes by differences, and a plain Gauss–Newton iteration.

use kapvik_firmware::rover::{PerAxle, Rover};
use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::WheelState;
use kapvik_host::identifiability::beforehand::{Beforehand, prior_stds};
use kapvik_host::identifiability::cost::CostWeights;
use kapvik_host::identifiability::manoeuvre::{Leg, Pattern, RimSpeeds};
use kapvik_host::identifiability::rover_side::RoverMeasurement;
use kapvik_host::identifiability::search::{DrivenLeg, Manoeuvre, Question, SETTLING_S};
use kapvik_host::identifiability::sensors::{FRAMES_PER_SECOND, LastingErrors};
use kapvik_host::parameter::Parameter;
use kapvik_host::prior::KAPVIK_WHEEL;
use kapvik_host::soil_catalogue::TABLE_1;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

const TIME_S: f64 = 20.0;
const DRAWS: usize = 120;
/// ln c, φ, ln K, n, ln k, c₁, c₂.
const SOIL: usize = 7;
/// Those, and the velocimeter's scale and the pitch.
const SHARED: usize = SOIL + 2;
/// Biases of three load cells and of three torques.
const OWN: usize = 6;
/// With the biases of left and right.
const UNKNOWNS: usize = SHARED + 2 * OWN;
/// White errors of a side: slip, load, torque and pull of three wheels, and the pitch.
const WHITE: usize = 13;
/// Three torques, forces along and across the ground, moments of bogie and rocker.
const CHANNELS: usize = 7;

type Channels = SVector<f64, CHANNELS>;
type Unknowns = [f64; UNKNOWNS];

/// One standard deviation of what uneven ground adds to a pull in one frame, N.
fn ground_n() -> f64 {
    0.5 * FRAMES_PER_SECOND.sqrt()
}

fn soil_of(x: &[f64]) -> Soil<f64> {
    Soil {
        cohesion_pa: x[0].exp(),
        friction_angle_rad: x[1],
        shear_modulus_m: x[2].exp(),
        sinkage_exponent: x[3],
        frictional_modulus: x[4].exp(),
        cohesive_modulus: 0.0,
        peak_stress_c1: x[5],
        peak_stress_c2: x[6],
        rebound_ratio: 0.0,
    }
}

/// Table 1 of the seed, without lasting errors.
fn truth() -> Unknowns {
    let mut x = [0.0; UNKNOWNS];
    let soil = TABLE_1;
    x[..SOIL].copy_from_slice(&[
        soil.cohesion_pa.ln(),
        soil.friction_angle_rad,
        soil.shear_modulus_m.ln(),
        soil.sinkage_exponent,
        soil.stiffness(KAPVIK_WHEEL.width_m).ln(),
        soil.peak_stress_c1,
        soil.peak_stress_c2,
    ]);
    x
}

/// What is known beforehand of each unknown.
fn stds() -> Unknowns {
    let lasting = LastingErrors::default();
    let mut stds = [0.0; UNKNOWNS];
    stds[..SOIL].copy_from_slice(&prior_stds());
    stds[SOIL..SHARED].copy_from_slice(&[lasting.speed_scale, lasting.pitch_rad]);
    for (own, std) in stds[SHARED..].iter_mut().enumerate() {
        *std = if own % OWN < 3 { lasting.load_n } else { lasting.torque_nm };
    }
    stds
}

/// What one side showed in one leg, averaged.
#[derive(Clone, Copy)]
struct Seen {
    slips: [f64; 3],
    loads_n: [f64; 3],
    torques_nm: [f64; 3],
    ground_n: [f64; 3],
    pitch_rad: f64,
}

impl Seen {
    /// What the soil predicts less what was seen, with the unknowns and the biases of a side.
    fn channels(&self, x: &[f64], biases: &[f64]) -> Channels {
        let rover = Rover::<f64>::assumed();
        let soil = soil_of(x);
        let (mut pulls, mut torques, mut loads) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        for axle in 0..3 {
            let slip = self.slips[axle] - (1.0 - self.slips[axle].abs()) * x[SOIL];
            loads[axle] = self.loads_n[axle] - biases[axle];
            let state = WheelState::under_load(&rover.wheel, &soil, slip, loads[axle]).unwrap();
            pulls[axle] = state.drawbar_pull_n + self.ground_n[axle];
            torques[axle] = state.torque_nm;
        }
        let ([p1, p2, p3], [w1, w2, w3], [t1, t2, t3]) = (pulls, loads, torques);
        let half_n = 0.5 * rover.mass_kg * rover.gravity_m_s2;
        let (sine, cosine) = (self.pitch_rad - x[SOIL + 1]).sin_cos();
        let drive_nm = |axle: usize| self.torques_nm[axle] - biases[3 + axle];
        Channels::from([
            t1 - drive_nm(0),
            t2 - drive_nm(1),
            t3 - drive_nm(2),
            p1 + p2 + p3 - half_n * sine,
            w1 + w2 + w3 - half_n * cosine,
            -0.10 * (p2 + p3) - 0.175 * w2 + 0.175 * w3 - t2 - t3,
            -0.20 * p1 - 0.35 * w1 - t1 - 0.10 * (p2 + p3) + 0.175 * (w2 + w3) - half_n * 0.05 * sine,
        ])
    }
}

/// A leg as it truly is.
struct TrueLeg {
    quiet: Seen,
    /// Of the mean over the leg.
    slip_stds: [f64; 3],
    /// One over the root of the number of frames.
    root: f64,
    whitening: SMatrix<f64, CHANNELS, CHANNELS>,
}

impl TrueLeg {
    fn new(driven: &DrivenLeg, measured_s: f64) -> Self {
        let Rover { wheel, noise, .. } = Rover::<f64>::assumed();
        let (soil, wheels, speed) = (soil_of(&truth()), driven.drive.wheels.into_array(), driven.drive.hub_speed_m_s);
        let torques_nm =
            wheels.map(|state| WheelState::under_load(&wheel, &soil, state.slip, state.load_n).unwrap().torque_nm);
        let (slips, loads_n) = (wheels.map(|state| state.slip), wheels.map(|state| state.load_n));
        let quiet = Seen { slips, loads_n, torques_nm, ground_n: [0.0; 3], pitch_rad: 0.0 };
        let root = 1.0 / (measured_s * FRAMES_PER_SECOND).sqrt();
        let slip_stds = wheels.map(|state| {
            assert!(state.slip > 0.0);
            // 1 − v/(rω) by v and by ω.
            let by_rate = speed / state.rim_speed_m_s.powi(2) * noise.wheel_rate_rad_s * wheel.radius_m;
            root * (noise.velocity_m_s / state.rim_speed_m_s).hypot(by_rate)
        });
        let mut leg = Self { quiet, slip_stds, root, whitening: SMatrix::identity() };
        // The steady drive balances by the closed forms, too.
        let left_over = quiet.channels(&truth(), &[0.0; OWN]);
        assert!(left_over.amax() < 2e-3, "{left_over}");
        let mut covariance = SMatrix::zeros();
        for error in 0..WHITE {
            let one: [f64; WHITE] = std::array::from_fn(|place| f64::from(place == error));
            let change = leg.seen(&one, &truth(), &[0.0; OWN]).channels(&truth(), &[0.0; OWN]) - left_over;
            covariance += change * change.transpose();
        }
        leg.whitening = covariance.cholesky().unwrap().l();
        leg
    }

    /// What a side sees, with white errors in units of their standard deviations.
    fn seen(&self, white: &[f64; WHITE], x: &[f64], biases: &[f64]) -> Seen {
        let Rover { noise, gravity_m_s2, .. } = Rover::<f64>::assumed();
        let mut seen = self.quiet;
        for axle in 0..3 {
            let scale = (1.0 - self.quiet.slips[axle].abs()) * x[SOIL];
            seen.slips[axle] += self.slip_stds[axle] * white[axle] + scale;
            seen.loads_n[axle] += self.root * noise.load_cell_n * white[3 + axle] + biases[axle];
            seen.torques_nm[axle] += self.root * noise.motor_torque_nm * white[6 + axle] + biases[3 + axle];
            seen.ground_n[axle] += self.root * ground_n() * white[9 + axle];
        }
        seen.pitch_rad += x[SOIL + 1] + self.root * noise.accel_m_s2 / gravity_m_s2 * white[12];
        seen
    }
}

fn question() -> Question {
    Question {
        rover: Rover::assumed(),
        soil: soil_of(&truth()),
        targets: Parameter::ALL.to_vec(),
        accuracy: 0.1,
        longest_s: 120.0,
        steepest_rad: 0.0,
        speeds: RimSpeeds::default(),
        measurement: RoverMeasurement {
            sinkage_m: None,
            ground_n: ground_n(),
            lasting: LastingErrors::default(),
            beforehand: Beforehand::default(),
        },
        weights: CostWeights::default(),
    }
}

/// What a side showed in a leg, and where the biases of its sensors stand among the unknowns.
type SideSeen<'a> = (&'a TrueLeg, usize, Seen);

/// Residuals of unit variance: what was believed beforehand, and the channels of all sides in all legs.
fn residuals(x: &[f64], believed: &Unknowns, stds: &Unknowns, seen: &[SideSeen<'_>]) -> DVector<f64> {
    let mut all: Vec<f64> = (0..UNKNOWNS).map(|k| (x[k] - believed[k]) / stds[k]).collect();
    for (leg, own, seen) in seen {
        let found = seen.channels(x, &x[*own..*own + OWN]);
        all.extend(leg.whitening.solve_lower_triangular(&found).unwrap().iter());
    }
    DVector::from_vec(all)
}

/// The bound is the covariance by differences at the truth; and φ and ln K of estimates from simulated drives scatter about the truth as the bound says. What is believed beforehand is
/// drawn anew for every drive: it is one more measurement.
fn scatter(ratios: &[[f64; 3]]) {
    let question = question();
    let driven = |ratios: &[f64; 3]| {
        let pattern = Pattern::Roll(PerAxle::from_array(*ratios));
        question.driven(Leg { pattern, slope_rad: 0.0 }).unwrap()
    };
    let driven: Vec<DrivenLeg> = ratios.iter().map(driven).collect();
    let bound = question.bound(&Manoeuvre::of(&driven).unwrap(), TIME_S).unwrap();
    let measured_s = TIME_S / driven.len() as f64 - SETTLING_S;
    let legs: Vec<TrueLeg> = driven.iter().map(|driven| TrueLeg::new(driven, measured_s)).collect();

    let (truth, stds) = (truth(), stds());
    let sides = || legs.iter().flat_map(|leg| [(leg, SHARED), (leg, SHARED + OWN)]);
    let quiet: Vec<SideSeen<'_>> = sides().map(|(leg, own)| (leg, own, leg.quiet)).collect();
    let slopes = jacobian(&truth, &stds, |x| residuals(x, &truth, &stds, &quiet));
    let covariance = (slopes.transpose() * &slopes).try_inverse().unwrap();
    for (place, expected) in bound.stds().iter().enumerate() {
        let found = covariance[(place, place)].sqrt();
        println!("{ratios:?} unknown {place}: by differences {found}, bound {expected}");
        assert!((found / expected - 1.0).abs() < 2e-3, "unknown {place}: {found}, bound {expected}");
    }

    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut normal = || random.sample::<f64, _>(StandardNormal);
    let mut errors = Vec::new();
    for _ in 0..DRAWS {
        let (mut believed, mut actual) = (truth, truth);
        for place in 0..UNKNOWNS {
            let drawn = if place < SOIL { &mut believed } else { &mut actual };
            drawn[place] += stds[place] * normal();
        }
        let seen: Vec<SideSeen<'_>> = sides()
            .map(|(leg, own)| {
                let white = std::array::from_fn(|_| normal());
                (leg, own, leg.seen(&white, &actual, &actual[own..own + OWN]))
            })
            .collect();
        let residuals = |x: &[f64]| residuals(x, &believed, &stds, &seen);
        errors.push(gauss_newton(&truth, &stds, residuals));
    }
    for (target, name) in [(1, "φ"), (2, "ln K")] {
        let squares: f64 = errors.iter().map(|x| (x[target] - truth[target]).powi(2)).sum();
        let (scatter, expected) = ((squares / DRAWS as f64).sqrt(), bound.stds()[target]);
        println!("{ratios:?} {name}: scatter {scatter}, bound {expected}");
        // The scatter of DRAWS normal errors is known to 1/√(2 DRAWS) of itself; what the curvature of the equations adds
        // is less than four of these.
        let tolerance = 4.0 / (2.0 * DRAWS as f64).sqrt();
        assert!((scatter / expected - 1.0).abs() < tolerance, "{name}: {scatter}, bound {expected}");
    }
}

#[test]
fn estimates_of_one_leg_scatter_as_the_bound_says() {
    scatter(&[[1.0, 1.3, 1.0]]);
}

/// Two legs, whose sensors have the same lasting errors.
#[test]
fn estimates_of_two_legs_scatter_as_the_bound_says() {
    scatter(&[[1.0, 1.3, 1.0], [1.0, 1.0, 1.3]]);
}

/// Slopes of the residuals, by differences.
fn jacobian(x: &[f64], scales: &[f64], residuals: impl Fn(&[f64]) -> DVector<f64>) -> DMatrix<f64> {
    let columns = scales.iter().enumerate().map(|(k, scale)| {
        let moved = |by: f64| {
            let mut moved = x.to_vec();
            moved[k] += by;
            residuals(&moved)
        };
        let step = 1e-4 * scale;
        (moved(step) - moved(-step)) / (2.0 * step)
    });
    DMatrix::from_columns(&columns.collect::<Vec<_>>())
}

/// The least sum of squares from `start`, by Gauss–Newton with steps that are halved until they lead down.
fn gauss_newton(start: &[f64], scales: &[f64], residuals: impl Fn(&[f64]) -> DVector<f64>) -> Vec<f64> {
    const SETTLED: f64 = 1e-6;
    let (mut x, mut at) = (start.to_vec(), residuals(start));
    for _ in 0..15 {
        let step = jacobian(&x, scales, &residuals).svd(true, true).solve(&at, 1e-14).unwrap();
        let shares = (0..12).map(|halvings| 0.5_f64.powi(halvings));
        let tried = shares.map(|share| x.iter().zip(&step).map(|(x, step)| x - share * step).collect::<Vec<f64>>());
        let lower = tried.map(|to| (residuals(&to), to)).find(|(found, _)| found.norm_squared() < at.norm_squared());
        let Some((found, to)) = lower else { break };
        let gain = at.norm_squared() - found.norm_squared();
        (x, at) = (to, found);
        if gain < SETTLED {
            break;
        }
    }
    x
}
