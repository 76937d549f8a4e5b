//! What a side knows of how well it does.

use core::hint::black_box;

use super::OUTPUTS;
use super::traits::TRAITS;
use crate::estimator::contact_forces::ContactForces;
use crate::estimator::side_estimator::SideEstimator;
use crate::estimator::side_frame::SENSORS;
use crate::math::octaves;
use crate::rover::PerAxle;
use crate::scalar::Scalar;

/// Inputs, which are magnitudes, with forces over the load at rest W₀ and torques over W₀ r, in this order: half octaves of the stated
/// standard deviations of torque, slip, contact angle, load and drawbar pull, of front, middle and rear wheel (15); slip, load and pull of
/// each (9), times 2; the bends of rocker and bogie, the differences between the contact angles of neighbours, rad, the trends of these
/// angles, rad/m (7), and how restless the ground is, 0 … 1, all times 8; the runs of innovations, of velocity up, rocker and bogie, then
/// of three cells and the moments on bogie and rocker, in standard deviations (8), times 2; for each sensor that cannot be used in this
/// frame 4, of encoders, drive torques and cells of the three wheels, of bogie, rocker and velocimeter (12). Behind these are the rover's
/// [traits](super::traits), which have signs.
pub const INPUTS: usize = 40 + SENSORS + TRAITS;

impl<S: Scalar> SideEstimator<S> {
    /// The inputs of the network, where the filters state such variances, in the order of its outputs.
    #[inline(never)] // flash is scarcer than the time of a call
    pub(in crate::estimator) fn doubt_inputs(
        &self,
        variances: &[S; OUTPUTS],
        contacts: &PerAxle<ContactForces<S>>,
    ) -> [f32; INPUTS] {
        let one = S::one();
        let per_rest = one / self.rover.load_at_rest_n();
        let per_torque = per_rest / self.rover.wheel.radius_m;
        let [of_torque, of_force] = [per_torque, per_rest].map(|per| per * per);
        let [mut known @ .., _] = *variances;
        to_octaves(&mut known, &[of_torque, one, one, of_force, of_force]);
        let wheels = contacts.as_ref().zip(self.wheels.as_ref()).map(|(contact, filter)| {
            let [_, _, slip] = *filter.estimate().mean();
            [slip, contact.load_n * per_rest, contact.pull_n * per_rest]
        });
        let [_, front, middle, rear, rocker, bogie, body] = *self.angles.estimate().mean();
        let [of_front, of_middle, of_rear] = self.angles.trends().per_m();
        let [rough, ..] = self.angles.trends().restless();
        let of_side =
            [rocker - body, bogie - rocker, front - middle, middle - rear, of_front, of_middle, of_rear, rough];
        let PerAxle { front, middle, rear } = &wheels;
        let parts: [(&[S], f32); 8] = [
            (&known, 0.25),
            (front, 2.0),
            (middle, 2.0),
            (rear, 2.0),
            (&of_side, 8.0),
            (self.angles.runs().means(), 2.0),
            (self.forces.runs().means(), 2.0),
            (&self.silent, 4.0),
        ];
        let mut inputs = [0.0; INPUTS];
        if let Some((changing, traits)) = inputs.split_last_chunk_mut() {
            magnitudes(&parts, changing);
            *traits = *self.doubt.traits();
        }
        inputs
    }
}

/// Numbers, times these in turn, to [`octaves`]. Behind a black box, since of a list of known length each number would have code of its
/// own.
#[inline(never)] // flash is scarcer than the time of a call
pub(super) fn to_octaves<S: Scalar>(numbers: &mut [S], times: &[S]) {
    for (place, times) in black_box(numbers).iter_mut().zip(times.iter().cycle()) {
        *place = S::from_f32(octaves((*times * *place).to_f32()));
    }
}

/// The magnitudes of the values of each part, so many times, one behind the other. Behind a black box for the same reason.
#[inline(never)] // as above
fn magnitudes<S: Scalar>(parts: &[(&[S], f32)], magnitudes: &mut [f32]) {
    let mut places = magnitudes.iter_mut();
    for (values, times) in black_box(parts) {
        for (value, place) in values.iter().zip(places.by_ref()) {
            *place = times * value.to_f32().abs();
        }
    }
}
