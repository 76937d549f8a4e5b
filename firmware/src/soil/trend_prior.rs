//! What is known of the trend over the wheels before any wheel is seen.
//!
//! Least squares over slips 0.02 … 0.7 under Kapvik's wheel, soil by soil of the training prior, with as many loads, give
//! coefficients of Legendre's polynomials of which mean and covariance are taken; each variance is made 0.3 % larger, which
//! keeps the inverse sound. Then all is turned to powers of u. A test of the host tools draws and fits anew.

use super::trend::{SINKAGE_TERMS, TERMS};

/// Distribution of the coefficients of a channel, given those of the channels before it: normal, with the inverse covariance
/// `precision` and a mean whose product with it is `shift` + Σ resistance coefficient · row of `by_resistance` + Σ sinkage
/// coefficient · row of `by_sinkage`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known<const N: usize, const R: usize, const S: usize> {
    /// Inverse covariance.
    pub precision: [[f32; N]; N],
    /// Precision times the mean where all coefficients of the channels before are zero.
    pub shift: [f32; N],
    /// Change of that with each coefficient of the resistance.
    pub by_resistance: [[f32; N]; R],
    /// Change of that with each coefficient of the sinkage.
    pub by_sinkage: [[f32; N]; S],
}

/// Of (T/r − DP)/W.
pub static RESISTANCE: Known<TERMS, 0, 0> = Known {
    precision: [
        [1.2017e3, 3.4541e3, -3.1527e3, -1.482e1, -2.9874e4, -1.7196e4],
        [3.4541e3, 7.4016e4, -8.572197e4, -4.4064e3, -5.8347e4, -5.2225e4],
        [-3.1527e3, -8.572197e4, 1.88138e5, -8.154761e4, 5.328333e4, -1.71812e5],
        [-1.482e1, -4.4064e3, -8.154761e4, 1.798266e5, -1.26958e4, -2.49315e5],
        [-2.9874e4, -5.8347e4, 5.328333e4, -1.26958e4, 9.1992e5, 1.9494e5],
        [-1.7196e4, -5.2225e4, -1.71812e5, -2.49315e5, 1.9494e5, 4.3476e6],
    ],
    shift: [4.7742e1, 1.2283e2, 9.032067e1, 5.08516e1, 4.6244e2, -4.0428e3],
    by_resistance: [],
    by_sinkage: [],
};

/// Of ln(z/r), given those of (T/r − DP)/W.
pub static SINKAGE: Known<SINKAGE_TERMS, TERMS, 0> = Known {
    precision: [
        [5.8575e1, 4.3417e2, -1.558683e2, 8.5473e2],
        [4.3417e2, 2.0566e4, -1.698928e4, 1.7831e3],
        [-1.558683e2, -1.698928e4, 2.908336e4, -8.78309e3],
        [8.5473e2, 1.7831e3, -8.78309e3, 1.8778e5],
    ],
    shift: [-1.2898e2, -1.4609e3, 3.1006e2, 1.1304e4],
    by_resistance: [
        [2.713e2, 2.134e3, -1.275267e2, -2.6576e4],
        [6.2826e2, 3.2541e4, -2.037325e4, -2.3395e4],
        [4.175e2, 1.914733e3, 1.683985e4, -1.642e4],
        [-4.32164e2, -2.26034e4, 5.022635e4, -2.37674e4],
        [8.6133e2, 1.3674e4, -4.633822e4, 7.5833e5],
        [-5.3865e2, -5.2819e4, -3.399483e3, 3.7994e5],
    ],
    by_sinkage: [],
};

/// Of T/(rW), given those of both.
pub static TORQUE: Known<TERMS, TERMS, SINKAGE_TERMS> = Known {
    precision: [
        [3.9893e2, -3.3132e2, 7.629433e2, -7.79072e2, 2.3822e3, 6.3674e3],
        [-3.3132e2, 4.6131e3, -6.263573e3, 1.324706e4, -1.3521e4, 1.6637e4],
        [7.629433e2, -6.263573e3, 1.719053e4, -2.09313e4, 1.8598e3, -4.609487e4],
        [-7.79072e2, 1.324706e4, -2.09313e4, 9.530296e4, 3.21994e4, -4.72418e4],
        [2.3822e3, -1.3521e4, 1.8598e3, 3.21994e4, 3.6959e5, -8.7439e4],
        [6.3674e3, 1.6637e4, -4.609487e4, -4.72418e4, -8.7439e4, 9.0123e5],
    ],
    shift: [1.3457e1, 3.7873e2, -4.91321e2, 5.44086e2, -5.0397e3, -1.0073e3],
    by_resistance: [
        [4.6095e2, -1.3767e3, 2.924317e3, -1.36414e3, 1.6873e4, -4.4058e3],
        [-1.0792e3, 5.8729e2, -9.475467e2, -7.780026e3, -3.0273e4, 1.1731e5],
        [2.443783e3, 2.535633e3, -8.664072e3, 9.404407e3, 5.8965e4, -9.266193e4],
        [-1.26256e3, 2.273654e3, 5.922192e3, 1.029675e4, 3.65042e4, 2.1798e4],
        [-1.0761e4, 1.9686e4, -4.9399e4, 2.83568e4, -3.0913e5, 1.3198e5],
        [5.9122e3, -2.8706e4, 1.371873e4, -4.73532e4, -3.4934e5, -2.0738e5],
    ],
    by_sinkage: [
        [1.3594e1, -1.6293e2, 1.868847e2, 4.5826e1, 1.529e3, -3.0998e3],
        [-6.0018e2, -7.8099e2, 2.786073e3, 2.274086e3, -8.8175e3, 1.3178e4],
        [4.82738e2, 7.5529e2, -3.187814e3, -2.821898e3, 4.222133e3, -2.994193e4],
        [8.4398e2, -5.0232e3, 8.18666e3, 3.43688e3, 1.0625e5, -5.3967e4],
    ],
};

/// Of T/(rW), given those of (T/r − DP)/W alone: where the sinkage is not seen.
pub static TORQUE_ALONE: Known<TERMS, TERMS, 0> = Known {
    precision: [
        [3.796608e2, -2.973694e2, 7.568687e2, -7.525719e2, 1.556886e3, 7.398984e3],
        [-2.973694e2, 4.222709e3, -5.759502e3, 1.341624e4, -9.340322e3, 1.047303e4],
        [7.568687e2, -5.759502e3, 1.63814e4, -2.131613e4, -3.192206e3, -4.068086e4],
        [-7.525719e2, 1.341624e4, -2.131613e4, 9.505186e4, 3.09304e4, -4.732588e4],
        [1.556886e3, -9.340322e3, -3.192206e3, 3.09304e4, 3.004801e5, -1.763191e4],
        [7.398984e3, 1.047303e4, -4.068086e4, -4.732588e4, -1.763191e4, 7.571304e5],
    ],
    shift: [3.694682e1, 4.857334e2, -4.408222e2, 6.539212e2, -1.548841e3, 3.861833e3],
    by_resistance: [
        [3.750243e2, -1.425772e3, 2.621174e3, -1.621667e3, 6.269798e3, -1.099241e4],
        [-1.25054e3, -1.561869e3, 1.590739e3, -7.072154e3, -2.589139e4, 7.079191e4],
        [1.393105e3, 3.836572e3, -8.252373e3, 1.105518e4, 2.06294e4, -4.820861e4],
        [-8.74347e2, 4.437223e3, -1.315259e2, 5.66283e3, 2.213054e4, -1.203338e4],
        [-7.659399e3, 5.31403e3, -2.380039e4, 3.966072e4, 7.474369e4, 8.24682e3],
        [7.897428e3, -3.132926e4, 2.26724e4, -4.155138e4, -1.520436e5, -1.340853e5],
    ],
    by_sinkage: [],
};

/// Mean of the coefficients of ln(z/r) given those of both forces, where the sinkage is not seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// The mean where all coefficients of the forces are zero.
    pub shift: [f32; SINKAGE_TERMS],
    /// Change of it with each coefficient of the resistance.
    pub by_resistance: [[f32; SINKAGE_TERMS]; TERMS],
    /// Change of it with each coefficient of the torque.
    pub by_torque: [[f32; SINKAGE_TERMS]; TERMS],
}

/// What [`SINKAGE`] and [`TORQUE`] say together.
pub static SINKAGE_EXPECTED: Expected = Expected {
    shift: [-3.0095, 1.4185e-2, 1.70089e-2, 7.6665e-2],
    by_resistance: [
        [5.86578, -4.24765e-2, -7.28331e-2, -1.84838e-1],
        [1.53293e1, 9.46231e-1, 6.08378e-1, -1.25009e-1],
        [-1.30465e1, 2.08789, 8.45076e-1, -3.33704e-2],
        [-5.11272, 8.90325e-1, 2.18564, -7.46724e-2],
        [-3.95407e1, 5.73685e-1, 9.21136e-1, 4.19295],
        [-6.00013e1, -2.71128, -2.07569, 2.57784],
    ],
    by_torque: [
        [2.57831e-1, -3.11209e-2, -9.25747e-3, 1.84252e-3],
        [-2.0948, 2.83842e-2, 3.86022e-2, -8.3805e-3],
        [2.04534, 1.60551e-2, -6.3461e-2, 2.19688e-2],
        [3.08784e-1, 3.50667e-2, -4.10448e-2, 1.20411e-2],
        [1.66262e1, -8.1023e-1, -3.94636e-1, 3.59628e-1],
        [-4.18245e1, 5.93054e-1, -2.27277e-1, 3.11902e-3],
    ],
};
