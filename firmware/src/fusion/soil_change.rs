//! Notices that the rover drives onto another soil.

use super::resistance_watch::{ResistanceWatch, Stiffness, motion_resistance};
use crate::estimator::WheelEstimate;
use crate::rover::{PerAxle, PerSide, PerWheel};

/// A change under one wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Arrival {
    stiffness: Stiffness,
    /// Travel since then, m.
    travel_m: f32,
}

/// Travel after which a change that only one side felt is taken for a stone, m.
const ONE_SIDED_M: f32 = 0.4;
/// Travel beyond the distance of front and rear hubs after which all wheels are taken to have arrived, m.
const BEYOND_REAR_M: f32 = 0.2;

/// Watches all wheels. A soil ends across the track, a stone under one side: a change counts when both sides feel it.
#[derive(Debug, Clone)]
pub struct SoilChangeDetector {
    watches: PerWheel<ResistanceWatch>,
    arrivals: PerWheel<Option<Arrival>>,
    /// The change that is under way, and travel since it was noticed, m.
    under_way: Option<Arrival>,
    changes: u16,
    radius_m: f32,
    crossing_m: f32,
}

impl SoilChangeDetector {
    /// A detector for wheels of a radius, the first and last of them so far apart, m.
    pub fn new(radius_m: f32, wheelbase_m: f32) -> Self {
        Self {
            watches: PerSide::both(PerAxle::all(ResistanceWatch::new())),
            arrivals: PerWheel::default(),
            under_way: None,
            changes: 0,
            radius_m,
            crossing_m: wheelbase_m + BEYOND_REAR_M,
        }
    }

    /// Changes noticed so far.
    pub fn changes(&self) -> u16 {
        self.changes
    }

    /// The wheels that stand on the newest soil, as far as is known.
    pub fn on_newest_soil(&self) -> PerWheel<bool> {
        let Some(change) = self.under_way else { return PerSide::both(PerAxle::all(true)) };
        self.arrivals.map_wheels(|arrival| arrival.is_some_and(|arrival| arrival.stiffness == change.stiffness))
    }

    /// The rover turns back over its soil. Other wheels bear more there, and what they met before tells nothing of what they meet now. Gives
    /// whether it was on its way onto another soil, which it then leaves again.
    pub fn turn_back(&mut self) -> bool {
        self.watches = PerSide::both(PerAxle::all(ResistanceWatch::new()));
        self.leave();
        self.under_way.take().is_some()
    }

    /// No wheel is on its way onto a soil.
    #[inline(never)] // flash is scarcer than the time of a call
    fn leave(&mut self) {
        self.arrivals = PerWheel::default();
    }

    /// Takes the wheels after some travel, m. How the soil changed, if that was noticed now.
    pub fn tick(&mut self, wheels: &PerWheel<WheelEstimate>, travel_m: f32) -> Option<Stiffness> {
        let radius_m = self.radius_m;
        let places = self.watches.iter_wheels_mut().zip(self.arrivals.iter_wheels_mut());
        for ((watch, arrival), wheel) in places.zip(wheels.iter_wheels()) {
            arrival.iter_mut().for_each(|arrival| arrival.travel_m += travel_m);
            let seen = motion_resistance(wheel, radius_m).and_then(|resistance| watch.see(resistance, travel_m));
            if let Some(stiffness) = seen {
                *arrival = Some(Arrival { stiffness, travel_m: 0.0 });
            }
        }
        match &mut self.under_way {
            Some(change) => {
                change.travel_m += travel_m;
                if change.travel_m > self.crossing_m {
                    self.under_way = None;
                    self.leave();
                }
                None
            }
            None => self.notice(),
        }
    }

    fn notice(&mut self) -> Option<Stiffness> {
        let stale = |arrival: &Arrival| arrival.travel_m > ONE_SIDED_M;
        self.arrivals = self.arrivals.map_wheels(|arrival| arrival.filter(|arrival| !stale(arrival)));
        let noticed = [Stiffness::Rises, Stiffness::Falls].into_iter().find(|stiffness| {
            let felt = |arrival: &Option<Arrival>| arrival.is_some_and(|arrival| arrival.stiffness == *stiffness);
            self.arrivals.as_array().into_iter().all(|side| side.as_array().into_iter().any(felt))
        })?;
        self.under_way = Some(Arrival { stiffness: noticed, travel_m: 0.0 });
        self.changes = self.changes.saturating_add(1);
        Some(noticed)
    }
}

#[cfg(test)]
mod tests {
    use super::SoilChangeDetector;
    use crate::estimator::{Estimate, WheelActivity, WheelEstimate};
    use crate::rover::{PerAxle, PerSide, PerWheel};

    /// Six wheels on plane ground whose pulls are zero, and whose torques are so much of load times radius.
    fn wheels(resistance: f32) -> PerWheel<WheelEstimate> {
        let known = |value: f32| Estimate { value, std: 0.001 };
        PerSide::both(PerAxle::all(WheelEstimate {
            activity: WheelActivity::Rolling,
            slip: Some(known(0.2)),
            normal_load_n: known(65.0),
            resistive_torque_nm: known(resistance * 65.0 * 0.075),
            ..WheelEstimate::default()
        }))
    }

    fn changes(turns_back: bool) -> u16 {
        let mut detector = SoilChangeDetector::new(0.075, 0.5);
        for frame in 0..400 {
            if turns_back && frame == 200 {
                detector.turn_back();
            }
            let _ = detector.tick(&wheels(if frame < 200 { 0.3 } else { 0.4 }), 0.002);
        }
        detector.changes()
    }

    #[test]
    fn what_wheels_meet_on_the_way_back_is_not_held_against_what_they_met() {
        assert_eq!(changes(false), 1);
        assert_eq!(changes(true), 0);
    }

    /// A rover that turns back on the border leaves the new soil again: all its wheels are on the old one, and nothing is under way.
    #[test]
    fn who_turns_back_on_the_border_leaves_the_new_soil() {
        let mut detector = SoilChangeDetector::new(0.075, 0.5);
        let under = |front: f32| {
            let mut wheels = wheels(0.3);
            let told = self::wheels(front);
            (wheels.left.front, wheels.right.front) = (told.left.front, told.right.front);
            wheels
        };
        (0..200).for_each(|_| _ = detector.tick(&under(0.3), 0.002));
        (0..100).for_each(|_| _ = detector.tick(&under(0.4), 0.002));
        assert_eq!((detector.changes(), detector.on_newest_soil().left.rear), (1, false));
        assert!(detector.turn_back());
        assert!(detector.on_newest_soil().left.rear && !detector.turn_back());
    }
}
