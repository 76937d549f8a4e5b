//! Six wheels with noise, and what an independent implementation says of them: NumPy and SciPy, the integrals of equations
//! 3–5 by 24 Gauss points a side, step 1 by `least_squares` within bounds, K by a grid and golden sections, κ₁ and κ₂ by
//! their published formulas with K = 11.4 mm.

use kapvik_firmware::identification::Observation;
use kapvik_firmware::wheel_state::WheelState;

use super::made::NOISE;

/// What was read, and what was made of it.
pub struct Case {
    /// Drawbar pull, load, torque, slip and sinkage of each wheel.
    wheels: [[f64; 5]; 6],
    /// c₁, c₂ and c₃.
    pub shape: [f64; 3],
    /// c (Pa), φ (degrees) and K (mm).
    pub ding: [f64; 3],
    /// c (Pa) and φ (degrees).
    pub iagnemma: [f64; 2],
    /// φ (degrees) with c held at zero.
    pub iagnemma_without_cohesion_deg: f64,
}

impl Case {
    /// The wheels as observed.
    pub fn observations(&self) -> [Observation<f64>; 6] {
        self.wheels.map(|[drawbar_pull_n, load_n, torque_nm, slip, sinkage_m]| Observation {
            state: WheelState { drawbar_pull_n, load_n, torque_nm, slip, sinkage_m: Some(sinkage_m) },
            noise: NOISE,
        })
    }
}

/// One instant at a load spread of ±50 %; a hundred instants at ±8 %; a hundred at ±50 %.
pub const CASES: [Case; 3] = [
    Case {
        wheels: [
            [-2.7331, 32.6369, 0.3217, 0.0614, 0.012224],
            [0.9968, 97.5106, 2.5739, 0.1611, 0.020566],
            [5.327, 98.5096, 2.8773, 0.2645, 0.021375],
            [3.2442, 33.5299, 0.8748, 0.3722, 0.015313],
            [4.139, 31.057, 0.9647, 0.4975, 0.012744],
            [10.2971, 97.8433, 3.4823, 0.6163, 0.021161],
        ],
        shape: [0.7, 0.30086, -0.46391],
        ding: [0.0, 30.4157, 3.9868],
        iagnemma: [-2608.239, 36.07606],
        iagnemma_without_cohesion_deg: 33.38179,
    },
    Case {
        wheels: [
            [-4.1467, 60.084, 0.9707, 0.0486, 0.017055],
            [0.8929, 70.7769, 1.6625, 0.1602, 0.018656],
            [3.6999, 60.2248, 1.6082, 0.2689, 0.017321],
            [6.6436, 70.8752, 2.1808, 0.3812, 0.019381],
            [7.1648, 60.2322, 1.9383, 0.4907, 0.017498],
            [8.7651, 70.7165, 2.4402, 0.598, 0.020112],
        ],
        shape: [0.21698, 0.27481, 0.0],
        ding: [1037.3, 30.2453, 13.3607],
        iagnemma: [-2465.092, 36.00098],
        iagnemma_without_cohesion_deg: 33.0964,
    },
    Case {
        wheels: [
            [-2.7548, 32.6946, 0.369, 0.0501, 0.011872],
            [1.6092, 98.2339, 2.5839, 0.1591, 0.02296],
            [2.0055, 32.6483, 0.7494, 0.2709, 0.011733],
            [8.0882, 97.9741, 3.1897, 0.3787, 0.023418],
            [9.4592, 97.9163, 3.366, 0.4888, 0.024173],
            [5.1679, 32.6795, 1.0354, 0.5987, 0.012395],
        ],
        shape: [0.21555, 0.27258, 0.0],
        ding: [430.8, 31.2392, 13.5712],
        iagnemma: [563.7126, 32.33101],
        iagnemma_without_cohesion_deg: 32.97783,
    },
];
