//! The activation of a layer of whole numbers: equation 13 by a table.

use core::mem::MaybeUninit;

use super::{Pair, Quad, unwritten};
use crate::math::tanh;

/// Fraction bits of an activation.
pub const ACTIVATION_BITS: u32 = 15;
/// Fraction bits of a sum that goes into the activation.
pub const SUM_BITS: u32 = 12;

/// Bits of a sum between two knots of the table, which are 1/32 apart.
const STEP_BITS: u32 = SUM_BITS - 5;
/// So far apart are the knots.
const STEP: i32 = 1 << STEP_BITS;
/// Knots on either side of zero.
const SIDE: usize = 1 << (15 - STEP_BITS);

/// tanh at whole multiples of 1/32 from −8 to 8, with 15 fraction bits.
static KNOTS: [i16; 2 * SIDE + 1] = knots();

const fn knots() -> [i16; 2 * SIDE + 1] {
    let mut knots = [0; 2 * SIDE + 1];
    let mut place = 0;
    while place <= SIDE {
        let nearest = (tanh(place as f32 / 32.0) * 32_768.0 + 0.5) as i32;
        let knot = if nearest < 32_767 { nearest as i16 } else { 32_767 };
        knots[SIDE + place] = knot;
        knots[SIDE - place] = -knot;
        place += 1;
    }
    knots
}

/// Bipolar sigmoid of equation 13 with the gradient coefficient A = 2, that is tanh, of a sum with 12 fraction bits;
/// the result has 15. Other coefficients go into weights and biases, times A/2.
///
/// Between knots 1/32 apart it is linear, rounded to nearest. Off by at most 1.16·10⁻⁴ (3.80 units of the last place),
/// and within ±32 767. Monotone. Odd, except that the middle between two results rounds up on both sides: there f(−x)
/// is 1 − f(x) in units of the last place, at 818 of the 65 536 arguments; and −8 has no counterpart.
#[inline]
pub fn bipolar_sigmoid(sum: i16) -> i16 {
    let sum = i32::from(sum);
    // −SIDE … SIDE − 1
    let knot = sum >> STEP_BITS;
    let next = sum & (STEP - 1);
    let neighbours = neighbours((knot + SIDE as i32) as usize);
    // Both knots' shares in one register: STEP − next below, next above.
    let shares = Pair((next * 0xffff + STEP).cast_unsigned());
    (neighbours.add_products(shares, STEP / 2) >> STEP_BITS) as i16
}

/// A knot and the one behind it.
#[inline]
fn neighbours(place: usize) -> Pair {
    match KNOTS.get(place..).and_then(|knots| knots.first_chunk()) {
        Some(&[knot, next]) => Pair::new(knot, next),
        None => Pair::ZERO,
    }
}

/// Sums shifted right to 12 fraction bits, towards −∞, and saturated at ±8; of each the bipolar sigmoid.
pub(super) fn activated<const T: usize>(sums: &[[i32; 4]; T], shift: u32) -> [Quad; T] {
    let mut activations = MaybeUninit::uninit();
    activate(sums, shift, unwritten(&mut activations));
    // SAFETY: there are as many sums as places, and `activate` writes a place for each.
    unsafe { activations.assume_init() }
}

// One copy in the image for layers of all sizes.
#[inline(never)]
fn activate(sums: &[[i32; 4]], shift: u32, places: &mut [MaybeUninit<Quad>]) {
    for (place, sums) in places.iter_mut().zip(sums) {
        let [a, b, c, d] = sums.map(|sum| bipolar_sigmoid(saturated(sum.wrapping_shr(shift))));
        place.write([Pair::new(a, b), Pair::new(c, d)]);
    }
}

#[inline]
fn saturated(sum: i32) -> i16 {
    sum.clamp(i16::MIN.into(), i16::MAX.into()) as i16
}

#[cfg(test)]
mod tests {
    use super::{activated, bipolar_sigmoid};
    use crate::network::fixed_point::Pair;

    fn exact(sum: i16) -> f64 {
        (f64::from(sum) / 4096.0).tanh()
    }

    #[test]
    fn error_is_as_stated_at_every_argument() {
        let mut worst = 0.0_f64;
        let mut last = i16::MIN;
        for sum in i16::MIN..=i16::MAX {
            let activation = bipolar_sigmoid(sum);
            assert!(activation.checked_abs().is_some());
            assert!(activation >= last, "{sum}");
            last = activation;
            worst = worst.max((f64::from(activation) / 32_768.0 - exact(sum)).abs());
        }
        println!("worst error {worst:e}, {} units", worst * 32_768.0);
        assert!(worst <= 1.16e-4, "{worst:e}");
    }

    #[test]
    fn odd_but_for_the_middle_between_two_results() {
        let mut uneven = 0;
        for sum in 0..=i16::MAX {
            match bipolar_sigmoid(sum) + bipolar_sigmoid(-sum) {
                0 => (),
                off => {
                    assert_eq!(off, 1, "{sum}");
                    uneven += 2;
                }
            }
        }
        assert_eq!(uneven, 818);
    }

    #[test]
    fn sums_are_shifted_and_saturated() {
        let sums = [[0, -1, 4096 << 5, i32::MAX], [i32::MIN, -(1 << 5), 31, (1 << 20) - 1]];
        let expected = [[0, -1], [4096, 32_767], [-32_768, -1], [0, 32_767]].map(|pair| pair.map(bipolar_sigmoid));
        assert_eq!(activated(&sums, 5).as_flattened(), expected.map(|[a, b]| Pair::new(a, b)));
    }
}
