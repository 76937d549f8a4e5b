//! The rover network's list of inputs.

use super::shape::{ROVER_CONTEXT, ROVER_INPUTS, ROVER_WHEELS, WHEEL_FEATURES, WHEEL_LN_LOAD, WHEEL_SLIP};

/// The inputs that the wheels share, those of the wheels, and the number of wheels, 1 for six and 0 for none.
///
/// The wheels stand in the order of their slip (and load, where slips are equal), so that the order in which they come does
/// not matter and neighbours in the list are neighbours on the curves over slip. Fewer wheels than six are repeated to fill
/// the list; those beyond the sixth are left out.
pub fn rover_inputs(
    context: &[f32; ROVER_CONTEXT],
    wheels: impl IntoIterator<Item = [f32; WHEEL_FEATURES]>,
) -> [f32; ROVER_INPUTS] {
    let mut seen = [[0.0; WHEEL_FEATURES]; ROVER_WHEELS];
    let mut count = 0;
    for (place, wheel) in seen.iter_mut().zip(wheels) {
        *place = wheel;
        count += 1;
    }
    let mut inputs = [0.0; ROVER_INPUTS];
    if let Some((shared, others)) = inputs.split_first_chunk_mut() {
        *shared = *context;
        let (slots, rest) = others.as_chunks_mut();
        let by_slip = in_order(seen.get(..count).unwrap_or_default());
        for (slot, place) in slots.iter_mut().enumerate() {
            let wheel = by_slip.get(slot * count / ROVER_WHEELS).and_then(|&wheel| seen.get(wheel));
            *place = *wheel.unwrap_or(&[0.0; WHEEL_FEATURES]);
        }
        rest.iter_mut().for_each(|place| *place = count as f32 * (1.0 / ROVER_WHEELS as f32));
    }
    inputs
}

/// The places of so many wheels at most, the one with the least slip first.
#[inline(never)] // where it is known how many wheels there can be, each is compared with each in code of its own
fn in_order(wheels: &[[f32; WHEEL_FEATURES]]) -> [usize; ROVER_WHEELS] {
    let mut ranks = [0; ROVER_WHEELS];
    for (later, wheel) in wheels.iter().enumerate() {
        let mut rank = later;
        for (peer, of_peer) in wheels.iter().zip(&mut ranks).take(later) {
            if is_before(wheel, peer) {
                *of_peer += 1;
                rank -= 1;
            }
        }
        ranks.get_mut(later).into_iter().for_each(|place| *place = rank);
    }
    let mut places = [0; ROVER_WHEELS];
    for (place, rank) in ranks.into_iter().enumerate().take(wheels.len()) {
        places.get_mut(rank).into_iter().for_each(|ranked| *ranked = place);
    }
    places
}

fn is_before(wheel: &[f32; WHEEL_FEATURES], peer: &[f32; WHEEL_FEATURES]) -> bool {
    let (slip, of_peer) = (wheel[WHEEL_SLIP], peer[WHEEL_SLIP]);
    slip < of_peer || (slip == of_peer && wheel[WHEEL_LN_LOAD] < peer[WHEEL_LN_LOAD])
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTEXT: [f32; ROVER_CONTEXT] = [0.5; ROVER_CONTEXT];

    fn wheel(slip: f32, ln_load: f32) -> [f32; WHEEL_FEATURES] {
        let mut wheel = [slip + 10.0 * ln_load; WHEEL_FEATURES];
        (wheel[WHEEL_SLIP], wheel[WHEEL_LN_LOAD]) = (slip, ln_load);
        wheel
    }

    /// Slips of the list, and its last number.
    fn slips(wheels: &[[f32; WHEEL_FEATURES]]) -> ([f32; ROVER_WHEELS], f32) {
        let inputs = rover_inputs(&CONTEXT, wheels.iter().copied());
        assert_eq!(inputs[..ROVER_CONTEXT], CONTEXT);
        let (slots, _) = inputs[ROVER_CONTEXT..].as_chunks::<WHEEL_FEATURES>();
        for slot in slots {
            assert!(wheels.is_empty() || wheels.contains(slot), "{slot:?} is none of {wheels:?}");
        }
        (std::array::from_fn(|slot| slots[slot][WHEEL_SLIP]), inputs[ROVER_INPUTS - 1])
    }

    #[test]
    fn wheels_stand_in_the_order_of_their_slip_then_load() {
        let wheels =
            [wheel(0.3, 0.1), wheel(-0.2, 0.0), wheel(0.6, 0.2), wheel(0.3, -0.1), wheel(0.0, 0.3), wheel(0.1, 0.0)];
        assert_eq!(slips(&wheels), ([-0.2, 0.0, 0.1, 0.3, 0.3, 0.6], 1.0));
        let ahead = rover_inputs(&CONTEXT, wheels);
        for turn in 1..ROVER_WHEELS {
            let mut turned = wheels;
            turned.rotate_left(turn);
            assert_eq!(rover_inputs(&CONTEXT, turned), ahead);
        }
    }

    #[test]
    fn fewer_wheels_fill_the_list() {
        let wheels = [wheel(0.4, 0.0), wheel(0.2, 0.0), wheel(0.1, 0.0), wheel(0.3, 0.0)];
        assert_eq!(slips(&wheels[..0]), ([0.0; ROVER_WHEELS], 0.0));
        assert_eq!(slips(&wheels[..1]), ([0.4; ROVER_WHEELS], 1.0 / 6.0));
        assert_eq!(slips(&wheels[..2]), ([0.2, 0.2, 0.2, 0.4, 0.4, 0.4], 2.0 / 6.0));
        assert_eq!(slips(&wheels), ([0.1, 0.1, 0.2, 0.3, 0.3, 0.4], 4.0 / 6.0));
    }

    #[test]
    fn a_seventh_wheel_is_left_out_and_no_number_is_an_accident() {
        let wheels: [_; 7] = std::array::from_fn(|k| wheel(0.1 * k as f32, 0.0));
        assert_eq!(rover_inputs(&CONTEXT, wheels), rover_inputs(&CONTEXT, wheels.into_iter().take(6)));
        let _ = rover_inputs(&CONTEXT, [wheel(f32::NAN, 0.0); 6]);
    }
}
