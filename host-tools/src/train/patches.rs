//! Patches of ground: the wheels of one rover on several soils at once.

use kapvik_firmware::terramechanics::Soil;
use kapvik_firmware::wheel_state::WHEELS;

use crate::prior::{self, SOIL_PARAMETERS};

/// Where the parameters of a soil lie in the ranges of the prior, each as a share 0 … 1 of its range.
type SoilShares = [f64; SOIL_PARAMETERS];

/// The soils under the wheels of a scene.
#[derive(Debug, Clone)]
pub struct Patches {
    /// The soil that the patches lie around; of ground that is one soil, that soil.
    middle: SoilShares,
    under: [SoilShares; WHEELS],
}

impl Patches {
    /// A share of `patchy_share` of all grounds is patchy: two to six soils, each parameter anywhere within a reach of its middle,
    /// each wheel on any of them. `share` gives numbers from 0 to below 1.
    pub fn draw(middle: SoilShares, patchy_share: f64, mut share: impl FnMut() -> f64) -> Self {
        if share() >= patchy_share {
            return Self { middle, under: [middle; WHEELS] };
        }
        let reach = prior::PATCH_REACH.at(share());
        let count = 2 + (share() * (WHEELS - 1) as f64) as usize;
        let patches: [SoilShares; WHEELS] =
            std::array::from_fn(|_| middle.map(|at| mirrored(at + reach * (2.0 * share() - 1.0))));
        let under = std::array::from_fn(|_| patches[(share() * count as f64) as usize]);
        Self { middle, under }
    }

    /// The soil under the wheel at a place.
    pub fn under(&self, place: usize) -> Soil<f64> {
        prior::soil_at(self.under[place])
    }

    /// What is to be told of the ground under the first `count` wheels: the mean over them of each parameter, or of its logarithm
    /// where that is uniform in the prior.
    pub fn mean(&self, count: usize) -> Soil<f64> {
        // Ways from the middle: the mean of one soil is then that soil to the last bit.
        let way = |parameter: usize| -> f64 {
            let ways = self.under.iter().take(count).map(|under| under[parameter] - self.middle[parameter]);
            ways.sum::<f64>() / count as f64
        };
        prior::soil_at(std::array::from_fn(|parameter| self.middle[parameter] + way(parameter)))
    }
}

/// A share that lies beyond an end of its range, as far within it.
fn mirrored(share: f64) -> f64 {
    let share = share.abs();
    share.min(2.0 - share)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Patches of a middle near an end of every range, drawn with numbers that a multiplicative generator gives.
    fn drawn(patchy_share: f64, seed: u64) -> Patches {
        let mut state = seed;
        let share = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        Patches::draw([0.95; SOIL_PARAMETERS], patchy_share, share)
    }

    #[test]
    fn ground_that_is_not_patchy_is_one_soil_to_the_last_bit() {
        let ground = drawn(0.0, 1);
        let whole = prior::soil_at([0.95; SOIL_PARAMETERS]);
        for count in 1..=WHEELS {
            assert_eq!(ground.mean(count), whole);
            assert_eq!(ground.under(count - 1), whole);
        }
    }

    #[test]
    fn patches_stay_in_the_prior_and_within_reach() {
        let mut differ = 0;
        for seed in 1..200 {
            let ground = drawn(1.0, seed);
            for shares in &ground.under {
                let farthest = 0.95 - prior::PATCH_REACH.high;
                assert!(shares.iter().all(|share| (farthest..=1.0).contains(share)), "{shares:?}");
            }
            differ += usize::from(ground.under.iter().any(|under| under != &ground.under[0]));
        }
        // Six wheels fall on one of two patches in one of 32 grounds.
        assert!(differ > 180, "{differ} of 199 grounds have more than one soil under the wheels");
    }

    #[test]
    fn the_mean_is_that_of_friction_angles_and_of_logarithms() {
        let ground = drawn(1.0, 7);
        let mean = |pick: fn(Soil<f64>) -> f64| (0..3).map(|place| pick(ground.under(place))).sum::<f64>() / 3.0;
        let told = ground.mean(3);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(close(told.friction_angle_rad, mean(|soil| soil.friction_angle_rad)));
        assert!(close(libm::log(told.cohesion_pa), mean(|soil| libm::log(soil.cohesion_pa))));
        assert!(close(libm::log(told.shear_modulus_m), mean(|soil| libm::log(soil.shear_modulus_m))));
    }
}
