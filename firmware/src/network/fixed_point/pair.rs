//! Two numbers of 16 bits in a register, which the target multiplies at once.

#[cfg(target_arch = "arm")]
use core::arch::asm;

use crate::network::words;

/// Two whole numbers of 16 bits side by side, the first in the lower half.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair(pub u32);

/// Four whole numbers of 16 bits.
pub type Quad = [Pair; 2];

impl Pair {
    /// Both zero.
    pub const ZERO: Self = Self(0);

    /// Puts two numbers side by side.
    #[inline]
    pub const fn new(first: i16, second: i16) -> Self {
        Self(first.cast_unsigned() as u32 | (second.cast_unsigned() as u32) << 16)
    }

    /// The two numbers.
    #[inline]
    pub const fn halves(self) -> [i16; 2] {
        [self.0 as i16, (self.0 >> 16) as i16]
    }

    /// `sum` and the products of the first two and the second two numbers; wraps around at 32 bits.
    #[cfg(not(target_arch = "arm"))]
    #[inline]
    pub fn add_products(self, other: Self, sum: i32) -> i32 {
        let ([a, b], [x, y]) = (self.halves(), other.halves());
        let [first, second] = [i32::from(a) * i32::from(x), i32::from(b) * i32::from(y)];
        sum.wrapping_add(first).wrapping_add(second)
    }

    /// See the portable one. The compiler does not find the instruction by itself.
    #[cfg(target_arch = "arm")]
    #[inline]
    pub fn add_products(self, other: Self, sum: i32) -> i32 {
        let total;
        // SAFETY: reads and writes the registers named, and the flag that tells of an overflow; no memory.
        unsafe {
            asm!(
                "smlad {total}, {a}, {b}, {sum}",
                total = lateout(reg) total,
                a = in(reg) self.0,
                b = in(reg) other.0,
                sum = in(reg) sum,
                options(pure, nomem, nostack),
            );
        }
        total
    }
}

words!(Pair: 0);

#[cfg(test)]
mod tests {
    use super::Pair;

    #[test]
    fn halves_are_what_was_put_in() {
        for halves in [[0, -1], [i16::MIN, i16::MAX], [-2, 3]] {
            assert_eq!(Pair::new(halves[0], halves[1]).halves(), halves);
        }
        assert_eq!(Pair::new(1, 2), Pair(0x0002_0001));
    }

    #[test]
    fn products_are_added_and_wrap_around() {
        assert_eq!(Pair::new(3, -5).add_products(Pair::new(-7, 11), 100), 100 - 21 - 55);
        let least = Pair::new(i16::MIN, i16::MIN);
        assert_eq!(least.add_products(least, -1), i32::MAX);
        assert_eq!(least.add_products(least, 0), i32::MIN);
    }
}
