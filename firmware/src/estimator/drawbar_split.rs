//! How the two wheels of a bogie share their drawbar pull.
//!
//! The bogie's balance tells only the sum: both hubs hang at the same height under the pivot. The seed shares it in
//! proportion to load. But the pull of a wheel follows its torque (Ding et al. 2009 give DP as a sum of M/r and W with
//! factors of the contact's shape alone), so the torques tell how the two differ.
//!
//! The form is ours: DP₂ − DP₃ = a ΔT/r + (b ΣDP − c ΣT/r) ΔW/ΣW − d Δs W̄ + 4e ((ΔW/ΣW)² − f) ΔW, fitted to equations 1–11 over
//! the soils that the networks are trained for. The host's test `drawbar_split` draws other soils, and finds the spread that is stated here.

use crate::rover::Planar;
use crate::scalar::Scalar;

/// The factors a, b, c, d, e, and f.
pub(super) const OF_TORQUE: f64 = 1.065;
const OF_PULL: f64 = 1.362;
const OF_TORQUES: f64 = 1.395;
const OF_SLIP: f64 = 0.0549;
const OF_LOAD_CUBED: f64 = 0.0309;
/// f: (ΔW/ΣW)² where the last term is none.
const EVEN_SHARE: f64 = 0.0549;
/// One standard deviation of what the form leaves, per newton of ΔW and of Δs W̄, and what is left of two equal wheels, N. Below slip 0 the
/// form was not fitted: there, per newton of skid times W̄.
const SPREAD_OF_LOAD: f64 = 0.0125;
const SPREAD_OF_SLIP: f64 = 0.042;
const SPREAD_OF_SKID: f64 = 0.15;
const LEAST_SPREAD_N: f64 = 0.08;

/// One standard deviation of what is left of the difference that two soils make, over it.
const OF_TWO_SOILS: f64 = 0.5;

/// Wheels that start are not yet as deep as their loads and slips would have them, and their torques tell less of how they share their pull:
/// one standard deviation of the difference, over the sum of their loads, and over that of how fast they sink.
const OF_DIGGING: f64 = 0.75;
/// One standard deviation of what the seed's rule leaves of the difference of two pulls, over the sum of the loads, and over that and the
/// difference of the slips.
const BY_LOAD_SPREAD: f64 = 0.03;
const BY_LOAD_SPREAD_OF_SLIP: f64 = 0.3;

/// One wheel of a bogie as its share is told from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BogieWheel<S> {
    /// Normal load W, N.
    pub load_n: S,
    /// Resistive torque over radius, T/r, N.
    pub rim_force_n: S,
    /// Slip.
    pub slip: S,
    /// 1 where it rolls forward, −1 where it rolls back: then pull and torque are those of its mirror image, and slip is not.
    pub direction: S,
}

/// How the drawbar pulls of a bogie's wheels differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawbarSplit<S> {
    /// Drawbar pull of the middle wheel less that of the rear wheel, N.
    pub difference_n: S,
    /// One standard deviation of that, N.
    pub std_n: S,
}

impl<S: Scalar> DrawbarSplit<S> {
    /// The split that torques, loads and slips tell, for wheels whose drawbar pulls sum to `sum_n`.
    pub fn by_torque(middle: &BogieWheel<S>, rear: &BogieWheel<S>, sum_n: S) -> Self {
        let loads = middle.load_n + rear.load_n;
        let torques = middle.rim_force_n + rear.rim_force_n;
        let unequal_load = middle.load_n - rear.load_n;
        let mean_load = loads * S::constant(0.5);
        let unequal_slip = (middle.slip - rear.slip) * mean_load * middle.direction;
        let per_load = if loads > S::one() {
            // Where one bears all it is 1; errors of filter 2 may make a load negative.
            let uneven = unequal_load / loads;
            (S::constant(OF_PULL) * sum_n - S::constant(OF_TORQUES) * torques) / loads
                + middle.direction
                    * S::constant(4.0 * OF_LOAD_CUBED)
                    * ((uneven * uneven).min(S::one()) - S::constant(EVEN_SHARE))
        } else {
            S::zero()
        };
        let difference_n = S::constant(OF_TORQUE) * (middle.rim_force_n - rear.rim_force_n) + unequal_load * per_load
            - S::constant(OF_SLIP) * unequal_slip;
        let load = S::constant(SPREAD_OF_LOAD) * unequal_load;
        let slip = S::constant(SPREAD_OF_SLIP) * unequal_slip;
        let skid = S::constant(SPREAD_OF_SKID) * middle.slip.min(rear.slip).min(S::zero()) * mean_load;
        let least = S::constant(LEAST_SPREAD_N);
        Self { difference_n, std_n: (load * load + slip * slip + skid * skid + least * least).sqrt() }
    }

    /// The split of wheels on two soils, of which the middle one compacts by this share of its load more than the rear one.
    pub fn on_two_soils(self, (middle, rear): (&BogieWheel<S>, &BogieWheel<S>), unlike_share: S) -> Self {
        let unlike_n = S::constant(0.5) * unlike_share * (middle.load_n + rear.load_n);
        let unsure_n = S::constant(OF_TWO_SOILS) * unlike_n;
        Self {
            difference_n: self.difference_n - unlike_n,
            std_n: (self.std_n * self.std_n + unsure_n * unsure_n).sqrt(),
        }
    }

    /// The split of wheels that dig in, of which this variance is known of how fast they sink, over the speed of their rims: what the seed's
    /// rule tells counts as well, as far as it is surer.
    pub fn while_digging(self, (middle, rear): (&BogieWheel<S>, &BogieWheel<S>), sum_n: S, sinking: S) -> Self {
        let loads_n = middle.load_n + rear.load_n;
        let by_load_n = Self::by_load_n(middle.load_n, rear.load_n, sum_n);
        // Variances as shares of the squared loads, which may be none.
        let digging = S::constant(OF_DIGGING * OF_DIGGING) * sinking;
        let of_slip = S::constant(BY_LOAD_SPREAD_OF_SLIP) * (middle.slip - rear.slip).abs();
        let by_load_std = S::constant(BY_LOAD_SPREAD) + of_slip;
        let of_load = by_load_std * by_load_std;
        let by_torque = of_load / (of_load + digging);
        Self {
            difference_n: by_load_n + by_torque * (self.difference_n - by_load_n),
            std_n: (self.std_n * self.std_n + by_torque * digging * loads_n * loads_n).sqrt(),
        }
    }

    /// The seed's rule: each wheel pulls in proportion to its load. The difference of the two, N.
    pub fn by_load_n(middle_load_n: S, rear_load_n: S, sum_n: S) -> S {
        let loads = middle_load_n + rear_load_n;
        if loads > S::one() { sum_n * (middle_load_n - rear_load_n) / loads } else { S::zero() }
    }
}

/// Normal load and drawbar pull of a force on a hub, N, for a contact at an angle to the link that the force is given in;
/// sine and cosine of that angle.
pub(super) fn along_contact<S: Scalar>(force: Planar<S>, angle: (S, S)) -> (S, S) {
    let turned = force.turned_back(angle);
    (turned.z, turned.x)
}
