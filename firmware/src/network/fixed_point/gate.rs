//! Layers that multiply one another.

use core::mem::MaybeUninit;

use super::activation::ACTIVATION_BITS;
use super::{Pair, Quad, unwritten};

/// The products of two layers' activations, number by number, with 15 fraction bits; what is below them is cut off
/// towards −∞, at most 2⁻¹⁵.
///
/// Activations stay within ±32 767, and so do their products. Of all numbers of 16 bits only −32 768 · −32 768 has a
/// product that has no place in them; it becomes −32 768.
pub fn gated<const T: usize>(gate: &[Quad; T], value: &[Quad; T]) -> [Quad; T] {
    let mut products = MaybeUninit::uninit();
    multiply(gate, value, unwritten(&mut products));
    // SAFETY: there are as many gates and values as places, and `multiply` writes a place for each.
    unsafe { products.assume_init() }
}

// One copy in the image for layers of all sizes.
#[inline(never)]
fn multiply(gate: &[Quad], value: &[Quad], products: &mut [MaybeUninit<Quad>]) {
    for ((product, gate), value) in products.iter_mut().zip(gate).zip(value) {
        let ([a, b], [c, d]) = (*gate, *value);
        product.write([times(a, c), times(b, d)]);
    }
}

#[inline]
fn times(gate: Pair, value: Pair) -> Pair {
    // One half of the gate at a time, for left to itself the compiler takes the second product apart.
    let [first, second] = [0x0000_ffff, 0xffff_0000].map(|half| Pair(gate.0 & half).add_products(value, 0));
    Pair::new((first >> ACTIVATION_BITS) as i16, (second >> ACTIVATION_BITS) as i16)
}

#[cfg(test)]
mod tests {
    use super::gated;
    use crate::network::fixed_point::Pair;

    #[test]
    fn products_are_those_of_the_numbers() {
        let numbers = [-32_767, -32_766, -20_000, -181, -1, 0, 1, 2, 181, 16_384, 32_766, 32_767_i16];
        for a in numbers {
            for b in numbers {
                let exact = f64::from(a) * f64::from(b) / 32_768.0;
                let expected = exact.floor() as i16;
                let gate = [[Pair::new(a, 7), Pair::new(b, a)]; 2];
                let value = [[Pair::new(b, -9), Pair::new(a, 32_767)]; 2];
                let [first, second] = gated(&gate, &value);
                assert_eq!(first, second);
                let [[ab, small], [ba, nearly_a]] = first.map(Pair::halves);
                assert_eq!([ab, ba, small], [expected, expected, -1], "{a} · {b}");
                assert!((i32::from(nearly_a) - i32::from(a)).abs() <= 1);
                assert!(ab.checked_abs().is_some());
            }
        }
    }
}
