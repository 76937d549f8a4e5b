//! How steeply wheels sink as their loads grow.
//!
//! A hub rises along the terrain less what its wheel sinks meanwhile. On plane ground that is nothing; over a rock, loads change
//! by tens of newtons within a wheel radius, and the hub's path departs from the terrain's slope by a degree.
//! Pressure–sinkage laws give W ∝ z^(n + ½) and so dz/dW = z/((n + ½) W): with the soils of the literature, a sinkage of 8 to
//! 25 mm under 67 N and n about 1, some 0.08 to 0.25 mm/N. How a slip that changes makes a wheel sink is left out.

use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// Sinkage for a load, m/N: between those bounds.
const SINKAGE_FOR_LOAD: f64 = 1.5e-4;
/// Travel over which the growth of a load is averaged, m: a load's noise must not pass for sinking.
const AVERAGED_OVER: f64 = 0.01;
/// No wheel sinks more steeply than so, rad: beyond it the load has jumped, and the wheel was lifted or set down.
const STEEPEST: f64 = 0.3;
/// A side that travels less than this in a frame stands, m.
const LEAST_TRAVEL: f64 = 1.0e-4;

/// How steeply the wheels of a side sink.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sinking<S> {
    slopes_rad: PerAxle<S>,
    /// Which cells told the loads of the frame before.
    seen: PerAxle<bool>,
}

impl<S: Scalar> Sinking<S> {
    /// None does.
    pub fn new() -> Self {
        Self { slopes_rad: PerAxle::all(S::zero()), seen: PerAxle::all(false) }
    }

    /// Sinkage over travel of each wheel, rad.
    pub fn slopes(&self) -> &PerAxle<S> {
        &self.slopes_rad
    }

    /// Takes how the loads, N, have changed over so much travel, and which cells told them: what becomes known of a load when a cell
    /// speaks again is no change of it.
    #[inline(never)] // flash is scarcer than the time of a call
    pub fn follow(&mut self, travel_m: S, seen: PerAxle<bool>, before: PerAxle<S>, after: PerAxle<S>) {
        let told = core::mem::replace(&mut self.seen, seen).zip(seen).map(|(before, now)| before && now);
        if travel_m < S::constant(LEAST_TRAVEL) {
            self.slopes_rad = PerAxle::all(S::zero());
            return;
        }
        let share = travel_m / (travel_m + S::constant(AVERAGED_OVER));
        let per_load = S::constant(SINKAGE_FOR_LOAD) / travel_m;
        let steepest = S::constant(STEEPEST);
        let changes = told.zip(before.zip(after)).into_array();
        for (slope, (told, (before, after))) in self.slopes_rad.as_array_mut().into_iter().zip(changes) {
            let change = if told { after - before } else { S::zero() };
            let now = (per_load * change).max(-steepest).min(steepest);
            *slope += share * (now - *slope);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Sinking;
    use crate::rover::PerAxle;

    const ALL: PerAxle<bool> = PerAxle { front: true, middle: true, rear: true };

    /// A load that grows by 20 N over 0.2 m, a hundredth of that a frame: 0.15 mm/N make 3 mm over 0.2 m, 0.015.
    #[test]
    fn a_wheel_sinks_as_its_load_grows_and_not_where_it_stands() {
        let mut sinking = Sinking::<f64>::new();
        for _ in 0..100 {
            sinking.follow(0.002, ALL, PerAxle::all(60.0), PerAxle { front: 60.2, middle: 60.0, rear: 59.8 });
        }
        let PerAxle { front, middle, rear } = *sinking.slopes();
        assert!((front - 0.015).abs() < 1.0e-6 && middle == 0.0 && (rear + 0.015).abs() < 1.0e-6, "{front} {rear}");
        sinking.follow(0.0, ALL, PerAxle::all(60.0), PerAxle::all(90.0));
        assert_eq!(*sinking.slopes(), PerAxle::all(0.0));
    }

    #[test]
    fn a_load_that_becomes_known_anew_is_no_sinking() {
        let mut sinking = Sinking::<f64>::new();
        let silent = PerAxle { rear: false, ..ALL };
        sinking.follow(0.002, ALL, PerAxle::all(60.0), PerAxle::all(60.0));
        sinking.follow(0.002, silent, PerAxle::all(60.0), PerAxle::all(60.5));
        sinking.follow(0.002, ALL, PerAxle::all(60.5), PerAxle::all(70.0));
        let PerAxle { front, rear, .. } = *sinking.slopes();
        assert!(front > 0.0 && rear == 0.0, "{front} {rear}");
    }
}
