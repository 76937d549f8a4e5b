//! How steeply wheels sink as their loads grow.
//!
//! A hub rises along the terrain less what its wheel sinks meanwhile. On plane ground that is nothing; over a rock, loads change
//! by tens of newtons within a wheel radius, and the hub's path departs from the terrain's slope by a degree.
//! Pressure–sinkage laws give W ∝ z^(n + ½) and so dz/dW = z/((n + ½) W): with the soils of the literature, a sinkage of 8 to
//! 25 mm under 67 N and n about 1, some 0.08 to 0.25 mm/N. How a slip that changes makes a wheel sink is left out.

use super::scale::Scale;
use super::trend::LEAST_TRAVEL;
use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// Sinkage for a load of set K0, m/N: between those bounds. A wheel made for more sinks less for a newton more.
const SINKAGE_FOR_LOAD: f64 = 1.5e-4;
/// Travel over which the growth of a load is averaged, m: a load's noise must not pass for sinking.
const AVERAGED_OVER: f64 = 0.01;
/// No wheel sinks more steeply than so, rad: beyond it the load has jumped, and the wheel was lifted or set down.
const STEEPEST: f64 = 0.3;

/// How steeply the wheels of a side sink.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sinking<S> {
    slopes_rad: PerAxle<S>,
    /// The loads of the frame before; none of a wheel whose cell was silent.
    loads_n: PerAxle<Option<S>>,
    /// Sinkage for a load, m/N.
    for_load: S,
}

impl<S: Scalar> Sinking<S> {
    /// None does.
    pub fn new(scale: &Scale<S>) -> Self {
        let for_load = S::constant(SINKAGE_FOR_LOAD) / scale.force;
        Self { slopes_rad: PerAxle::all(S::zero()), loads_n: PerAxle::all(None), for_load }
    }

    /// Sinkage over travel of each wheel, rad: a hub that sinks goes down forward, and up against the way backward.
    pub fn slopes(&self) -> &PerAxle<S> {
        &self.slopes_rad
    }

    /// Takes the loads after so much travel, less than none backward, N; none where the cell is silent: what becomes known of a load when its
    /// cell speaks again is no change of it.
    pub fn follow(&mut self, travel_m: S, loads_n: &PerAxle<Option<S>>) {
        let before = core::mem::replace(&mut self.loads_n, *loads_n);
        let way_m = travel_m.abs();
        if way_m < S::constant(LEAST_TRAVEL) {
            self.slopes_rad = PerAxle::all(S::zero());
            return;
        }
        let share = way_m / (way_m + S::constant(AVERAGED_OVER));
        let per_load = self.for_load / travel_m;
        let steepest = S::constant(STEEPEST);
        let loads = before.as_array().into_iter().zip(loads_n.as_array());
        for (slope, (before, after)) in self.slopes_rad.as_array_mut().into_iter().zip(loads) {
            let change = if let (Some(before), Some(after)) = (before, after) { *after - *before } else { S::zero() };
            let now = (per_load * change).max(-steepest).min(steepest);
            *slope += share * (now - *slope);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Scale, Sinking};
    use crate::rover::{PerAxle, Rover};

    fn sinking() -> Sinking<f64> {
        Sinking::new(&Scale::of(&Rover::assumed()))
    }

    fn loads(front: f64, middle: f64, rear: Option<f64>) -> PerAxle<Option<f64>> {
        PerAxle { front: Some(front), middle: Some(middle), rear }
    }

    /// A load that grows by 20 N over 0.2 m, a hundredth of that a frame: 0.15 mm/N make 3 mm over 0.2 m, 0.015.
    #[test]
    fn a_wheel_sinks_as_its_load_grows_and_not_where_it_stands() {
        let mut sinking = sinking();
        for frame in 0..=100 {
            let change = 0.2 * f64::from(frame);
            sinking.follow(0.002, &loads(60.0 + change, 60.0, Some(60.0 - change)));
        }
        let PerAxle { front, middle, rear } = *sinking.slopes();
        assert!((front - 0.015).abs() < 1.0e-6 && middle == 0.0 && (rear + 0.015).abs() < 1.0e-6, "{front} {rear}");
        sinking.follow(0.0, &loads(90.0, 90.0, Some(90.0)));
        assert_eq!(*sinking.slopes(), PerAxle::all(0.0));
    }

    /// The same way back, load for load: the hub comes up where it went down, along the same path.
    #[test]
    fn a_wheel_that_rolls_back_comes_up_along_the_same_path() {
        let (mut forth, mut back) = (sinking(), sinking());
        for frame in 0..=100 {
            let change = 0.2 * f64::from(frame);
            forth.follow(0.002, &loads(60.0 + change, 60.0, None));
            back.follow(-0.002, &loads(80.0 - change, 60.0, None));
        }
        let (forth, back) = (forth.slopes().front, back.slopes().front);
        assert!(forth > 0.014 && (forth - back).abs() < 1.0e-9, "{forth} {back}");
    }

    #[test]
    fn a_load_that_becomes_known_anew_is_no_sinking() {
        let mut sinking = sinking();
        for (load, rear) in [(60.0, Some(60.0)), (60.5, None), (70.0, Some(70.0))] {
            sinking.follow(0.002, &loads(load, load, rear));
        }
        let PerAxle { front, rear, .. } = *sinking.slopes();
        assert!(front > 0.0 && rear == 0.0, "{front} {rear}");
    }
}
