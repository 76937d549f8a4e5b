//! What is known of the trend over the wheels before any wheel is seen.
//!
//! Least squares over slips 0.02 … 0.7 under Kapvik's wheel, soil by soil of the training prior, with as many loads, give
//! coefficients of Legendre's polynomials of which mean and covariance are taken; each variance is made 0.3 % larger, which
//! keeps the inverse sound. Then all is turned to powers of the slip's measure. A test of the host tools draws and fits anew.

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
        [1.29757e3, 3.14108e3, -5.41974e3, -7.98875e2, -3.22957e4, -1.78001e4],
        [3.14108e3, 8.02452e4, -1.12433e5, 1.34221e4, -4.98564e4, 1.50731e4],
        [-5.41974e3, -1.12433e5, 2.97961e5, -2.1587e5, 1.2254e5, -1.68972e5],
        [-7.98875e2, 1.34221e4, -2.1587e5, 3.17186e5, -2.97625e4, 1.94026e5],
        [-3.22957e4, -4.98564e4, 1.2254e5, -2.97625e4, 9.91517e5, 1.31188e5],
        [-1.78001e4, 1.50731e4, -1.68972e5, 1.94026e5, 1.31188e5, 5.47214e6],
    ],
    shift: [4.52888e1, 5.4305e1, 2.32425e2, -5.12585e2, 6.80065e2, -5.35518e3],
    by_resistance: [],
    by_sinkage: [],
};

/// Of ln(z/r), given those of (T/r − DP)/W.
pub static SINKAGE: Known<SINKAGE_TERMS, TERMS, 0> = Known {
    precision: [
        [6.22988e1, 5.16811e2, -2.62353e2, 8.32906e2],
        [5.16811e2, 2.40719e4, -2.15797e4, 6.45471e2],
        [-2.62353e2, -2.15797e4, 3.50019e4, -9.84267e3],
        [8.32906e2, 6.45471e2, -9.84267e3, 2.13091e5],
    ],
    shift: [-1.44999e2, -1.89918e3, 6.76175e2, 1.32782e4],
    by_resistance: [
        [2.98246e2, 3.03944e3, -9.85825e2, -3.25148e4],
        [7.17367e2, 3.77616e4, -2.95033e4, -8.38126e3],
        [8.16698e2, 1.21001e4, 3.96681e3, 1.44645e4],
        [-1.27172e3, -5.56912e4, 8.50231e4, 9.30834e3],
        [8.7737e2, 8.32533e3, -4.58737e4, 8.97084e5],
        [-1.16316e3, -5.71378e4, -2.10177e4, 4.95275e5],
    ],
    by_sinkage: [],
};

/// Of T/(rW), given those of both.
pub static TORQUE: Known<TERMS, TERMS, SINKAGE_TERMS> = Known {
    precision: [
        [4.1609e2, -1.40585e2, 1.3165e3, -1.26801e2, 2.05668e3, 6.63688e3],
        [-1.40585e2, 4.51572e3, -4.44837e3, 1.63219e4, 5.01967e3, 1.92584e4],
        [1.3165e3, -4.44837e3, 1.70108e4, -1.91831e4, -4.66468e3, 4.50729e4],
        [-1.26801e2, 1.63219e4, -1.91831e4, 9.33051e4, 3.08423e4, 3.71499e4],
        [2.05668e3, 5.01967e3, -4.66468e3, 3.08423e4, 3.89565e5, -9.8123e4],
        [6.63688e3, 1.92584e4, 4.50729e4, 3.71499e4, -9.8123e4, 9.67557e5],
    ],
    shift: [1.27367e1, 8.08543e1, -7.18623e2, 3.81901e2, -6.80345e3, -1.22711e3],
    by_resistance: [
        [4.80016e2, -3.98603e2, 2.77738e3, -1.16737e3, 2.19086e4, -4.81803e3],
        [-1.42895e3, -1.87881e3, 1.52434e4, -1.46651e3, -4.98595e4, 1.52832e5],
        [3.94703e3, 1.08829e4, -4.39305e4, 2.56819e4, 4.94213e4, -1.32623e5],
        [-3.10587e3, -6.3835e3, 3.37869e4, -2.15661e4, 1.63728e4, 8.95102e3],
        [-1.10008e4, 7.97031e2, -4.31653e4, 1.66958e4, -4.37063e5, 1.57377e5],
        [5.39898e3, -5.37955e4, -3.09237e4, -7.82074e4, -4.79718e5, -3.51305e5],
    ],
    by_sinkage: [
        [1.09578e1, -1.2383e2, -1.00768e2, -1.95635e2, 1.72317e3, -3.53135e3],
        [-1.03078e3, -2.82108e3, 8.14692e3, -2.81191e3, -1.82212e3, -1.34068e3],
        [1.06363e3, 2.70127e3, -1.11225e4, 2.11316e3, -6.24694e3, -1.19619e4],
        [7.67596e2, 1.92025e2, 5.76101e3, 2.21757e3, 1.3407e5, -6.05596e4],
    ],
};

/// Of T/(rW), given those of (T/r − DP)/W alone: where the sinkage is not seen.
pub static TORQUE_ALONE: Known<TERMS, TERMS, 0> = Known {
    precision: [
        [3.83277e2, -1.88112e2, 1.54767e3, -1.61582e2, 1.27826e3, 7.57647e3],
        [-1.88112e2, 4.18425e3, -4.16353e3, 1.58753e4, 6.15475e3, 1.49499e4],
        [1.54767e3, -4.16353e3, 1.46018e4, -1.91802e4, -4.16783e3, 3.70126e4],
        [-1.61582e2, 1.58753e4, -1.91802e4, 9.2633e4, 3.21392e4, 2.96165e4],
        [1.27826e3, 6.15475e3, -4.16783e3, 3.21392e4, 3.03532e5, -2.10107e4],
        [7.57647e3, 1.49499e4, 3.70126e4, 2.96165e4, -2.10107e4, 8.10831e5],
    ],
    shift: [4.08073e1, 4.62782e2, -3.04027e1, 1.1233e3, -1.70494e3, 4.35542e3],
    by_resistance: [
        [3.6909e2, -1.21386e3, 1.51462e3, -2.74484e3, 6.65973e3, -1.26112e4],
        [-1.38792e3, -4.28057e3, 1.27482e4, -5.41374e3, -3.17234e4, 9.07468e4],
        [1.53041e3, 6.68961e3, -2.40415e4, 2.28644e4, 3.0927e4, -8.70444e4],
        [-4.02102e2, 1.62192e3, 7.12335e3, -1.41409e4, 3.3246e3, 1.35051e3],
        [-7.66956e3, 7.57768e3, -2.10306e4, 3.44456e4, 6.69183e4, 1.98042e4],
        [6.64486e3, -4.39811e4, 4.0229e3, -5.52583e4, -1.87619e5, -2.24082e5],
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
    shift: [-2.96076, 1.49195e-2, 1.5769e-2, 7.70201e-2],
    by_resistance: [
        [5.85086, -6.43826e-2, -8.70507e-2, -1.93869e-1],
        [1.60077e1, 6.86428e-1, 5.64046e-1, -3.48592e-2],
        [-1.84034e1, 2.78525, 5.01446e-1, 1.59808e-1],
        [-9.37226, 1.13078e-1, 2.64153, 1.47754e-1],
        [-4.0745e1, 9.75901e-1, 1.35168, 4.35902],
        [-7.31245e1, -3.34868, -3.42319, 2.91354],
    ],
    by_torque: [
        [2.54727e-1, -3.09009e-2, -3.13982e-3, 1.96585e-3],
        [-1.48062, -2.94587e-2, 2.32714e-2, 1.12476e-2],
        [-2.44724, 1.2186e-1, -9.21514e-2, 2.51103e-2],
        [-2.61956, -2.15303e-2, 2.10107e-2, 2.46815e-2],
        [1.70247e1, -7.68773e-1, -4.70401e-1, 3.9052e-1],
        [-4.49419e1, 4.95362e-1, 5.13196e-2, 1.15866e-2],
    ],
};
