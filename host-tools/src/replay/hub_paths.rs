//! The paths of a side's hubs beside each other: how far those behind roll above or below where the front one did.

use kapvik_firmware::rover::{PerAxle, Planar};

use crate::statistics::running::Running;

/// So many heights of the front hub's path are kept.
const KEPT: usize = 64;

/// The paths of a side's hubs, and how they differ.
#[derive(Debug, Clone)]
pub struct HubPaths {
    /// Heights are compared wherever a hub comes by a multiple of this, m.
    step_m: f64,
    before_m: Option<PerAxle<Planar<f64>>>,
    /// How far the front hub has come, m.
    farthest_m: f64,
    /// Heights of the front hub there, each with the number of its place.
    front_m: [Option<(i64, f64)>; KEPT],
    middle: Running,
    rear: Running,
}

impl HubPaths {
    /// Of a rover of this length, m, before its first frame.
    pub fn of_length(length_m: f64) -> Self {
        let step_m = length_m / (KEPT / 2) as f64;
        Self {
            step_m,
            before_m: None,
            farthest_m: f64::NEG_INFINITY,
            front_m: [None; KEPT],
            middle: Running::default(),
            rear: Running::default(),
        }
    }

    /// What comes has nothing to do with what was.
    pub fn begin_anew(&mut self) {
        (self.before_m, self.farthest_m, self.front_m) = (None, f64::NEG_INFINITY, [None; KEPT]);
    }

    /// Takes where the hubs are now, m. Where the front one goes back all begin anew.
    pub fn take(&mut self, hubs_m: PerAxle<Planar<f64>>) {
        let Some(before_m) = self.before_m.replace(hubs_m) else { return };
        self.farthest_m = self.farthest_m.max(before_m.front.x);
        if hubs_m.front.x < self.farthest_m - self.step_m {
            self.begin_anew();
            return;
        }
        if let Some((place, height_m)) = self.passed(before_m.front, hubs_m.front) {
            self.front_m[kept(place)] = Some((place, height_m));
        }
        let above_m = |before, now| {
            let (place, height_m) = self.passed(before, now)?;
            let (_, front_m) = self.front_m[kept(place)].filter(|(of_front, _)| *of_front == place)?;
            Some(height_m - front_m)
        };
        let (middle, rear) = (above_m(before_m.middle, hubs_m.middle), above_m(before_m.rear, hubs_m.rear));
        middle.into_iter().for_each(|above_m| self.middle.take(above_m));
        rear.into_iter().for_each(|above_m| self.rear.take(above_m));
    }

    /// The place that a hub has come by, and how high it was there, m.
    fn passed(&self, before: Planar<f64>, now: Planar<f64>) -> Option<(i64, f64)> {
        let place = (now.x / self.step_m).floor();
        let way_m = place * self.step_m - before.x;
        let height_m = || before.z + (now.z - before.z) * way_m / (now.x - before.x);
        (way_m > 0.0).then(|| (place as i64, height_m()))
    }

    /// How many times a hub came by where the front one had.
    pub fn compared(&self) -> f64 {
        self.middle.count + self.rear.count
    }

    /// How far middle and rear hub were from where the front one was, each about its own mean, m²: squares, added.
    pub fn apart(&self) -> f64 {
        self.middle.squares + self.rear.squares
    }
}

/// Where a place is kept.
fn kept(place: i64) -> usize {
    place.rem_euclid(KEPT as i64) as usize
}
