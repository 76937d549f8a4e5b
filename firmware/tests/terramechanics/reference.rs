//! Equations 1–11 integrated a second time, from their definition and adaptively, to judge the library by.
//!
//! Nothing is shared with the library but its input types: angles are taken as they are in the equations, the integral
//! is divided where the integrand is not smooth, finely towards those places, and each piece is halved until the 7- and
//! 15-point rules of Gauss and Kronrod agree.

use kapvik_firmware::terramechanics::{Soil, Wheel};

/// Forces by the reference, with the size of the stresses that they are the balance of.
#[derive(Debug, Clone, Copy)]
pub struct Reference {
    pub drawbar_pull_n: f64,
    pub load_n: f64,
    pub torque_nm: f64,
    /// rb ∫(σ + |τ|): what the load would be if nothing cancelled.
    pub stresses_n: f64,
}

/// The stresses under a wheel as the equations state them.
struct Stresses {
    radius_m: f64,
    entry: f64,
    peak: f64,
    exit: f64,
    stiffness_pa: f64,
    /// V = v/(rω), infinite for a locked wheel.
    speed_ratio: f64,
    soil: Soil<f64>,
}

impl Stresses {
    fn new(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, sinkage_m: f64) -> Self {
        let r = wheel.radius_m;
        let entry = ((r - sinkage_m) / r).acos();
        let exit = -((r - soil.rebound_ratio * sinkage_m) / r).acos();
        let margin = 1e-6 * (entry - exit);
        let peak = ((soil.peak_stress_c1 + soil.peak_stress_c2 * slip) * entry).clamp(exit + margin, entry - margin);
        let k = soil.cohesive_modulus / wheel.width_m + soil.frictional_modulus;
        let speed_ratio = if slip < 0.0 { 1.0 / (1.0 + slip) } else { 1.0 - slip };
        let stiffness_pa = k * r.powf(soil.sinkage_exponent);
        Self { radius_m: r, entry, peak, exit, stiffness_pa, speed_ratio, soil: *soil }
    }

    fn displacement_m(&self, theta: f64) -> f64 {
        let ground = self.entry.sin() - theta.sin();
        self.radius_m * ((self.entry - theta) - if ground > 0.0 { self.speed_ratio * ground } else { 0.0 })
    }

    /// The integrands of DP, W and T, and the size of the stresses.
    fn at(&self, theta: f64) -> [f64; 4] {
        let front = if theta >= self.peak {
            theta
        } else {
            self.entry - (theta - self.exit) / (self.peak - self.exit) * (self.entry - self.peak)
        };
        let sigma = self.stiffness_pa * (front.cos() - self.entry.cos()).max(0.0).powf(self.soil.sinkage_exponent);
        let j = self.displacement_m(theta);
        let mobilised = if j == 0.0 { 0.0 } else { -(-j.abs() / self.soil.shear_modulus_m).exp_m1() };
        let tau = (self.soil.cohesion_pa + sigma * self.soil.friction_angle_rad.tan()) * mobilised * j.signum();
        let (sin, cos) = theta.sin_cos();
        [tau * cos - sigma * sin, sigma * cos + tau * sin, tau, sigma + tau.abs()]
    }

    /// Where j changes its sign, by a scan and bisection.
    fn sign_changes(&self) -> Vec<f64> {
        const SCAN: usize = 4000;
        let place = |k: usize| self.entry + (self.exit - self.entry) * (k as f64 / SCAN as f64).powi(2);
        let positive = |theta: f64| self.displacement_m(theta) > 0.0;
        (1..SCAN)
            .filter(|&k| positive(place(k)) != positive(place(k + 1)))
            .map(|k| {
                let (mut a, mut b) = (place(k), place(k + 1));
                for _ in 0..60 {
                    let middle = 0.5 * (a + b);
                    if positive(middle) == positive(a) { a = middle } else { b = middle }
                }
                0.5 * (a + b)
            })
            .collect()
    }

    /// The pieces to integrate: divided at every place that is not smooth, and at distances from it that fall by four.
    fn divisions(&self) -> Vec<f64> {
        let mut special = vec![self.exit, self.peak, self.entry];
        if self.speed_ratio > 1.0 {
            special.extend(self.sign_changes());
        }
        let distances: Vec<f64> = (0..14).map(|k| 0.5 * (self.entry - self.exit) * 0.25_f64.powi(k)).collect();
        let around = |place: f64| distances.iter().flat_map(move |d| [place - d, place + d]).collect::<Vec<_>>();
        let mut divisions: Vec<f64> = special.iter().copied().flat_map(around).collect();
        divisions.retain(|theta| *theta > self.exit && *theta < self.entry);
        divisions.extend(special);
        divisions.sort_by(f64::total_cmp);
        divisions.dedup();
        divisions
    }
}

/// Forces of a wheel on a soil with K > 0, to about 1e-12 of the stresses; `slip` above −1.
pub fn forces(wheel: &Wheel<f64>, soil: &Soil<f64>, slip: f64, sinkage_m: f64) -> Reference {
    let stresses = Stresses::new(wheel, soil, slip, sinkage_m);
    let divisions = stresses.divisions();
    let pieces = || divisions.windows(2).map(|ends| (ends[0], ends[1]));
    let size: f64 = pieces().map(|(a, b)| gauss_kronrod(&stresses, a, b).0[3]).sum();
    let mut sum = [0.0; 4];
    for (a, b) in pieces() {
        integrate(&stresses, a, b, 1e-13 * size, 40, &mut sum);
    }
    let area = wheel.radius_m * wheel.width_m;
    Reference {
        drawbar_pull_n: area * sum[0],
        load_n: area * sum[1],
        torque_nm: area * wheel.radius_m * sum[2],
        stresses_n: area * sum[3],
    }
}

fn integrate(stresses: &Stresses, a: f64, b: f64, tolerance: f64, halvings: u32, sum: &mut [f64; 4]) {
    let (integral, difference) = gauss_kronrod(stresses, a, b);
    if difference <= tolerance || halvings == 0 {
        sum.iter_mut().zip(integral).for_each(|(total, part)| *total += part);
    } else {
        let middle = 0.5 * (a + b);
        integrate(stresses, a, middle, 0.7 * tolerance, halvings - 1, sum);
        integrate(stresses, middle, b, 0.7 * tolerance, halvings - 1, sum);
    }
}

/// The 15-point integral over a … b, and the greatest difference from the 7-point one that is embedded in it.
fn gauss_kronrod(stresses: &Stresses, a: f64, b: f64) -> ([f64; 4], f64) {
    let (centre, half) = (0.5 * (a + b), 0.5 * (b - a));
    let (mut kronrod, mut gauss) = ([0.0; 4], [0.0; 4]);
    for (abscissa, weight, gauss_weight) in GAUSS_KRONROD {
        let mirrored = if abscissa == 0.0 { &[1.0][..] } else { &[1.0, -1.0][..] };
        for sign in mirrored {
            for (m, value) in stresses.at(centre + sign * half * abscissa).into_iter().enumerate() {
                kronrod[m] += half * weight * value;
                gauss[m] += half * gauss_weight * value;
            }
        }
    }
    (kronrod, (0..4).map(|m| (kronrod[m] - gauss[m]).abs()).fold(0.0, f64::max))
}

/// Abscissa, weight in the 15-point rule, weight in the 7-point rule (QUADPACK, Piessens et al. 1983).
const GAUSS_KRONROD: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0),
    (0.741_531_185_599_394_5, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
];
