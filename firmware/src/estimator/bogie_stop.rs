//! A stop that holds a bogie, and what tells of its forces meanwhile.
//!
//! A wheel over a hole hangs as soon as its bogie has turned as far as it can, and by then it has lost little of its load. The stop's
//! moment acts on the bogie, and turned round on the rocker; taken for the soil's it makes a force along the one necessary, and an opposite
//! one along the other, each up to a wheel's weight and more. The torques know nothing of these: soil that is compacted as it was before
//! leaves them so much pull. Contact angles that are wrong make the two differ, too, but on front wheel and bogie independently.

use crate::scalar::Scalar;

/// Moments and torques differ about the force along a bogie by more than this, over the forces on its cells, where a stop holds it; and about
/// that along the rocker as much, the other way. On hills and rocks it is at most 0.06, in the frame in which a bogie meets its stop 0.15 to
/// 0.4.
const HELD_SHARE: f64 = 0.15;

/// What the torques tell of the forces along the links of a side.
#[derive(Debug, Clone, Copy)]
pub(super) struct AlongLinks<S> {
    /// The force along the bogie on its middle hub less that on its rear hub, N.
    pub difference_n: S,
    /// The force along the rocker on the front hub, N.
    pub rocker_n: S,
    /// That along the bogie on both its hubs, N.
    pub bogie_n: S,
    /// Whether these two are told by soil that the wheels have compacted before.
    pub are_known: bool,
}

impl<S: Scalar> AlongLinks<S> {
    /// Whether a stop holds the bogie, since cells and moments make such forces along rocker and bogie necessary, N; with the forces on the
    /// bogie's cells, N.
    pub fn tell_a_stop(&self, [rocker_n, bogie_n]: [S; 2], on_cells_n: S) -> bool {
        let (of_rocker, of_bogie) = (rocker_n - self.rocker_n, bogie_n - self.bogie_n);
        let differ = of_rocker.abs().min(of_bogie.abs()) > S::constant(HELD_SHARE) * on_cells_n;
        self.are_known && differ && of_rocker * of_bogie < S::zero()
    }
}

#[cfg(test)]
mod tests {
    use super::AlongLinks;

    /// 30 N along the links of a bogie that bears 140 N are a stop's doing where they are opposite on both, and soil that has been
    /// compacted before tells what they should be.
    #[test]
    fn opposite_forces_that_no_torque_knows_are_a_stop() {
        let along = AlongLinks { difference_n: 0.0, rocker_n: 5.0, bogie_n: -3.0, are_known: true };
        assert!(along.tell_a_stop([-25.0, 27.0], 140.0));
        assert!(!along.tell_a_stop([35.0, 27.0], 140.0), "angles that are wrong");
        assert!(!along.tell_a_stop([-15.0, 17.0], 140.0), "20 N may be a rock");
        assert!(!AlongLinks { are_known: false, ..along }.tell_a_stop([-25.0, 27.0], 140.0));
    }
}
