//! The track of a side: what its front wheel met where the wheels of the bogie will roll.
//!
//! The hubs of a side follow each other over the same ground. So under the middle and the rear wheel it turns as it did under the front wheel
//! there, which tells contact angles before links and velocity have moved. And where the front wheel's torque said that the path of its hub was
//! not the terrain, as over the border of a soil in which wheels sink deeper, theirs will not be either: of a bogie's two wheels, whose pulls
//! are known together only, that says which one of them is meant. Where its torque compacted more of one soil than of the next, so will theirs.
//!
//! What was seen while wheels started or dug in is no ground's doing. Wheels that roll back lead no track, nor do those of a rover that turns
//! sharply; that one which slides sideways leaves its track is not seen.

use super::compaction::REMEMBERED_M;
use super::side_estimator::SideEstimator;
use crate::rover::{PerAxle, Planar, Suspension};
use crate::scalar::Scalar;

/// Pieces that are remembered, of which these lie between the hubs of the front and the rear wheel on the level.
const PIECES: usize = 64;
const TO_REAR: f64 = 48.0;
/// The ground under a wheel begins before its hub: by about so much of a piece.
const BEFORE_HUB: f64 = 0.5;
/// No wheel passes more of them in a frame.
const FASTEST: f64 = 4.0;
/// A rover that turns by more than this on the way between those hubs, rad, cuts its corners.
const SHARPEST: f64 = 0.7;
/// How much of what torque says beside the path counts in how the ground turned.
const BY_TORQUE: f64 = 0.4;
/// One standard deviation of what errors of the front wheel's angle turn over a piece, rad.
const BY_ERRORS: f64 = 3.2e-3;
/// One standard deviation by which the shares of two wheels differ on one soil, on ground of any kind.
const BY_GROUND: f64 = 0.06;

/// What the front wheel met under a wheel that follows it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Met<S> {
    /// By how much the ground turns there, rad/m.
    pub turns_per_m: S,
    /// By how much it was steeper than the path of the hub, as the torque said, rad.
    pub steeper_rad: S,
}

/// One piece of it.
#[derive(Debug, Clone, Copy)]
struct Piece<S> {
    /// How far the ground had turned at its end, rad, and by how much it was steeper than the path of the hub there.
    turned_rad: S,
    steeper_rad: S,
    /// The mean share of the rim force that compacted the soil.
    share: S,
}

/// What is remembered, up to the rear wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Track<S> {
    pieces: [Piece<S>; PIECES],
    /// The piece that the front wheel is on, how many before it are known, and how far it is on it, of its length.
    at: usize,
    known: usize,
    on: S,
    pieces_per_m: S,
    /// How far the ground has turned since it was forgotten, rad, and at which angle it was last.
    turned_rad: S,
    angle_rad: S,
}

impl<S: Scalar> Track<S> {
    /// Nothing is remembered.
    pub fn new(suspension: &Suspension<S>) -> Self {
        let zero = S::zero();
        let [_, to_rear_m] = behind_front(suspension, zero, zero);
        Self {
            pieces: [Piece { turned_rad: zero, steeper_rad: zero, share: zero }; PIECES],
            at: 0,
            known: 0,
            on: zero,
            pieces_per_m: S::constant(TO_REAR) / to_rear_m,
            turned_rad: zero,
            angle_rad: zero,
        }
    }

    /// The hub of the front wheel has gone on by so much, m, on ground that is so restless, 0 … 1: its path is at such an angle, so much
    /// steeper the ground is, as the torque says, and such a share of that compacts the soil in the mean.
    fn follow(&mut self, forward_m: S, restless: S, path_rad: S, [steeper_rad, share]: [S; 2]) {
        let angle_rad = path_rad + S::constant(BY_TORQUE) * steeper_rad;
        self.turned_rad += restless * (angle_rad - self.angle_rad);
        self.angle_rad = angle_rad;
        self.on += forward_m * self.pieces_per_m;
        if !(self.on >= S::zero() && self.on < S::constant(FASTEST)) {
            self.on = S::zero();
            self.forget();
        }
        for _ in 0..FASTEST as usize {
            if let Some(here) = self.pieces.get_mut(self.at) {
                *here = Piece { turned_rad: self.turned_rad, steeper_rad, share };
            }
            if self.on < S::one() {
                break;
            }
            self.on -= S::one();
            self.at = (self.at + 1) % PIECES;
            self.known = (self.known + 1).min(PIECES - 1);
        }
    }

    /// Forgets it. How far the ground has turned is counted anew, so that it stays as precise however far a rover goes.
    fn forget(&mut self) {
        (self.known, self.turned_rad) = (0, S::zero());
    }

    /// How many pieces before the front wheel's own a place is that is so many lengths of one behind its hub, and how much farther back than
    /// the end of that piece, of its length; none where it is not known. What is read there goes over from piece to piece without a jump, or
    /// rounding would decide between two.
    #[inline(never)] // flash is scarcer than the time of a call
    fn back_and_on(&self, behind: S) -> Option<(usize, S)> {
        let pieces = (behind - self.on).max(S::zero());
        let whole = pieces.to_f32() as usize;
        (whole < self.known).then(|| (whole + 1, pieces - S::from_f32(whole as f32)))
    }

    #[inline(never)] // flash is scarcer than the time of a call
    fn piece(&self, back: usize) -> Option<&Piece<S>> {
        self.pieces.get((self.at + PIECES - back) % PIECES)
    }

    /// The piece before one that is known: at the end of what is remembered, that one itself.
    fn piece_before(&self, back: usize) -> Option<&Piece<S>> {
        self.piece(if back < self.known { back + 1 } else { back })
    }

    /// What it met where a hub is that is so far behind, m.
    #[inline(never)] // flash is scarcer than the time of a call
    fn behind(&self, behind_m: S) -> Option<Met<S>> {
        let (back, on) = self.back_and_on(behind_m * self.pieces_per_m - S::constant(BEFORE_HUB))?;
        let (ahead, here, before) = (self.piece(back - 1)?, self.piece(back)?, self.piece_before(back)?);
        let [turns, turned] = [ahead.turned_rad - here.turned_rad, here.turned_rad - before.turned_rad];
        let turns = surely(turns + on * (turned - turns), BY_ERRORS);
        let steeper_rad = here.steeper_rad + on * (before.steeper_rad - here.steeper_rad);
        Some(Met { turns_per_m: turns * self.pieces_per_m, steeper_rad })
    }

    /// By how much more of its load a wheel that is the first of these ways behind, m, compacts the soil than one that is the other, since
    /// soils differ. A mean lags by half of what it is taken over.
    fn unlike_share(&self, [middle_m, rear_m]: [S; 2]) -> S {
        let share = |behind_m: S| {
            let (back, on) = self.back_and_on((behind_m - S::constant(0.5 * REMEMBERED_M)) * self.pieces_per_m)?;
            let here = self.piece(back)?.share;
            Some(here + on * (self.piece_before(back)?.share - here))
        };
        let unlike = share(middle_m).zip(share(rear_m)).map(|(middle, rear)| middle - rear);
        unlike.map_or(S::zero(), |unlike| surely(unlike, BY_GROUND))
    }
}

/// What is left of a change when what is no larger than this standard deviation is taken for no change.
fn surely<S: Scalar>(change: S, std: f64) -> S {
    let square = change * change;
    square / (square + S::constant(std * std)) * change
}

impl<S: Scalar> SideEstimator<S> {
    /// Follows the track of a rover that turns at this rate, where it is known, and sees what the front wheel met under the middle and the rear
    /// wheel.
    pub(super) fn follow_track(&mut self, step_s: S, yaw_rate_rad_s: Option<S>) {
        let forward_m = self.motion.hub_velocities_m_s.front.x * step_s;
        let [restless, ..] = self.angles.trends().restless();
        let [of_front, _] = &self.compaction;
        let told = [self.corrections.front.steeper, of_front.mean()];
        self.track.follow(forward_m, restless, self.angles.angles().front, told);
        let sharpest_rad_s = S::constant(SHARPEST / TO_REAR) * self.track.pieces_per_m * self.speed_m_s();
        let turns = yaw_rate_rad_s.is_some_and(|rate| rate.abs() > sharpest_rad_s);
        if turns || !(of_front.was_ever_known() && self.settled().front && self.digging_in.is_over()) {
            self.track.forget();
        }
        let PerAxle { front: rocker_rad, rear: bogie_rad, .. } = self.angles.links();
        let behind_m = behind_front(&self.rover.suspension, rocker_rad, bogie_rad);
        self.met = behind_m.map(|behind_m| self.track.behind(behind_m));
        self.unlike_share = self.track.unlike_share(behind_m);
    }
}

/// How far the hubs of the middle and the rear wheel are behind that of the front wheel, m, with rocker and bogie at these pitches, rad; to
/// second order in these.
fn behind_front<S: Scalar>(suspension: &Suspension<S>, rocker_rad: S, bogie_rad: S) -> [S; 2] {
    let ahead =
        |place: Planar<S>, pitch_rad: S| place.x - pitch_rad * (place.z + S::constant(0.5) * pitch_rad * place.x);
    let of_pivot = ahead(suspension.front_hub - suspension.bogie_pivot, rocker_rad);
    [suspension.middle_hub, suspension.rear_hub].map(|hub| of_pivot - ahead(hub, bogie_rad))
}

#[cfg(test)]
mod tests {
    use super::{BY_ERRORS, BY_GROUND, REMEMBERED_M, Track, behind_front};
    use crate::rover::{Rover, Suspension};

    const STEP_M: f64 = 0.003;

    fn suspension() -> Suspension<f64> {
        Rover::<f64>::assumed().suspension
    }

    /// A front wheel that has gone so many steps: at first over plane ground, then from 0.3 m on up by 0.2 rad over 0.1 m, where its torque
    /// says that the ground is less steep by half of that.
    fn after(steps: i32) -> Track<f64> {
        let mut track = Track::new(&suspension());
        for step in 0..steps {
            let climbs = 2.0 * (STEP_M * f64::from(step) - 0.3).clamp(0.0, 0.1);
            let another_soil = if climbs == 0.0 { 0.1 } else { 0.3 };
            track.follow(STEP_M, 1.0, climbs, [-0.5 * climbs, another_soil]);
        }
        track
    }

    /// Where the front wheel was on the climb, 0.35 m before, the ground turns by 2 rad/m, less the share of what the torque says; where it was
    /// on plane ground, not at all.
    #[test]
    fn the_ground_turns_under_the_wheels_behind_as_it_did_under_the_front_wheel() {
        let track = after(234);
        let met = track.behind(0.35).expect("the front wheel was there");
        let told = 2.0 * (1.0 - 0.4 * 0.5);
        assert!((met.turns_per_m - told).abs() < 0.25 * told, "{met:?}");
        assert!((met.steeper_rad + 0.05).abs() < 0.02, "{met:?}");
        let before = track.behind(0.45).expect("and there");
        assert_eq!((before.turns_per_m, before.steeper_rad), (0.0, 0.0));
        let [to_middle, to_rear] = behind_front(&suspension(), 0.0, 0.0);
        assert!((to_middle - 0.35).abs() < 1.0e-12 && (to_rear - 0.7).abs() < 1.0e-12);
        assert!(track.behind(to_rear).is_some() && after(100).behind(to_middle).is_none());
    }

    /// Where the front wheel came to a soil that it compacts by 0.2 more, wheels that are on both sides of that place differ by nearly as much;
    /// wheels on the same side do not.
    #[test]
    fn wheels_on_two_soils_compact_unlike_shares() {
        let track = after(280);
        let half = 0.5 * REMEMBERED_M;
        let unlike = track.unlike_share([0.4 + half, 0.65 + half]);
        assert!((unlike - 0.2 * 0.04 / (0.04 + BY_GROUND * BY_GROUND)).abs() < 1.0e-9, "{unlike}");
        for same in [[0.2, 0.4], [0.6 + half, 0.65 + half], [0.4, 5.0]] {
            assert_eq!(track.unlike_share(same), 0.0, "{same:?}");
        }
    }

    /// What turns by less than the errors of an angle do tells next to nothing.
    #[test]
    fn errors_of_an_angle_are_no_ground() {
        let mut track = Track::new(&suspension());
        (0..300).for_each(|step| track.follow(STEP_M, 1.0, 0.1 * BY_ERRORS * f64::from(step % 2), [0.0; 2]));
        let met = track.behind(0.35).expect("the front wheel was there");
        assert!(met.turns_per_m.abs() < 0.01 * BY_ERRORS / 0.0146, "{met:?}");
    }

    /// Wheels that roll back lead no track, nor does one that has jumped; and a link that lies nose-up has its wheels nearer.
    #[test]
    fn what_is_not_driven_over_is_not_known() {
        for jump in [-0.1, 1.0, f64::NAN] {
            let mut track = after(300);
            track.follow(jump, 1.0, 0.0, [0.0; 2]);
            assert!(track.behind(0.05).is_none(), "{jump}");
            (0..300).for_each(|_| track.follow(STEP_M, 1.0, 0.0, [0.0; 2]));
            assert!(track.behind(0.7).is_some(), "{jump}");
        }
        let exactly = |pitch: f64| {
            let from_front = |x: f64, z: f64| x * pitch.cos() - z * pitch.sin();
            [from_front(0.35, -0.2 + 0.2), from_front(0.7, -0.2 + 0.2)]
        };
        for (told, exact) in behind_front(&suspension(), 0.3, 0.3).into_iter().zip(exactly(0.3)) {
            assert!((told - exact).abs() < 1.0e-3, "{told} {exact}");
        }
    }
}
