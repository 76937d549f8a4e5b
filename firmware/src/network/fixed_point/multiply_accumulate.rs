//! The innermost loop of a layer of whole numbers.
//!
//! Sums wrap around in both versions, so that the bits are the same in whatever order; that no sum of a sound table
//! does is proven when the table is made.

#[cfg(target_arch = "arm")]
pub use on_target::weighted_sums;
#[cfg(not(target_arch = "arm"))]
pub use portable::weighted_sums;

/// For any machine.
#[cfg(not(target_arch = "arm"))]
mod portable {
    use super::super::{Pair, Quad};

    /// The biases of each tile of neurons and the products of the inputs with its weights.
    #[inline]
    pub fn weighted_sums<const H: usize, const T: usize>(
        bias: &[[i32; 4]; T],
        input: &[Quad; H],
        weights: &[[[[Pair; 4]; 2]; H]; T],
    ) -> [[i32; 4]; T] {
        let mut sums = *bias;
        for (sums, tile) in sums.iter_mut().zip(weights) {
            for (pair, weights) in input.as_flattened().iter().zip(tile.as_flattened()) {
                sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum = pair.add_products(*weight, *sum));
            }
        }
        sums
    }
}

/// 0.77 instructions a product, of 44 inputs.
#[cfg(target_arch = "arm")]
mod on_target {
    use core::arch::asm;
    use core::mem::MaybeUninit;

    use super::super::{Pair, Quad};

    /// Quads of inputs in a turn of the loop.
    const TURN: usize = 4;

    /// Adds a quad of inputs times the weights of four neurons to the sums in r0 … r3.
    macro_rules! add_quad {
        () => {
            concat!("ldm r10!, {{r8, r9}}\n", add_quad!("r8"), add_quad!("r9"))
        };
        ($inputs:literal) => {
            concat!("ldm r11!, {{r4-r7}}\n", add_quad!($inputs: "r0" "r4", "r1" "r5", "r2" "r6", "r3" "r7"))
        };
        ($inputs:literal: $($sum:literal $weights:literal),+) => {
            concat!($("smlad ", $sum, ", ", $inputs, ", ", $weights, ", ", $sum, "\n"),+)
        };
    }

    /// See the portable one.
    #[inline]
    pub fn weighted_sums<const H: usize, const T: usize>(
        bias: &[[i32; 4]; T],
        input: &[Quad; H],
        weights: &[[[[Pair; 4]; 2]; H]; T],
    ) -> [[i32; 4]; T] {
        if H == 0 || T == 0 {
            return *bias;
        }
        let mut sums = MaybeUninit::<[[i32; 4]; T]>::uninit();
        // SAFETY: there is a tile and a quad; each of the `T` tiles has biases and weights for `H` quads of inputs,
        // one behind the other. All `T` tiles of sums are written before they are taken for sums.
        unsafe {
            sum_tiles(bias.as_ptr(), T, input.as_ptr(), H, weights.as_ptr().cast(), sums.as_mut_ptr().cast());
            sums.assume_init()
        }
    }

    /// Writes the sums of tiles of neurons. One copy in the image for layers of all shapes.
    ///
    /// # Safety
    /// There are biases of `tiles` tiles, at least one, and `quads` quads of inputs, at least one, and for each tile
    /// as many quads of weights, one behind the other; there is room for `tiles` tiles of sums, which nobody else
    /// refers to.
    #[inline(never)]
    unsafe fn sum_tiles(
        bias: *const [i32; 4],
        tiles: usize,
        input: *const Quad,
        quads: usize,
        weights: *const [[Pair; 4]; 2],
        sums: *mut [i32; 4],
    ) {
        // The first turn is shorter, so that the last ends with the inputs: so many quads are left out.
        let left_out = quads.wrapping_neg() % TURN;
        // SAFETY: each tile begins at the first input and leaves out quads of the first turn so that a turn ends with
        // the last one; as many quads of weights are read as there are inputs, for as many tiles as there are biases
        // before their end. Writes as many sums, and no other memory. Changes only the registers and flags named; r6
        // and r7, which cannot be named, are put back.
        unsafe {
            asm!(
                "vmov s4, s5, r6, r7",
                "vmov s0, s1, r0, r1",
                "vmov s2, s3, r2, r3",
                "2: vmov r10, s0",
                "ldm r10!, {{r0-r3}}",
                "vmov s0, r10",
                "vmov r10, r4, s2, s3",
                "tbb [pc, r4]",
                "3: .byte (4f-3b)/2, (5f-3b)/2, (6f-3b)/2, (7f-3b)/2",
                "4:",
                add_quad!(),
                "5:",
                add_quad!(),
                "6:",
                add_quad!(),
                "7:",
                add_quad!(),
                "cmp r10, lr",
                "bne 4b",
                "stm r12!, {{r0-r3}}",
                "vmov r4, r5, s0, s1",
                "cmp r4, r5",
                "bne 2b",
                "vmov r6, r7, s4, s5",
                inout("r0") bias => _,
                inout("r1") bias.wrapping_add(tiles) => _,
                inout("r2") input => _,
                inout("r3") left_out => _,
                out("r4") _, out("r5") _, out("r8") _, out("r9") _, out("r10") _,
                inout("r11") weights => _,
                inout("r12") sums => _,
                inout("lr") input.wrapping_add(quads) => _,
                out("s0") _, out("s1") _, out("s2") _, out("s3") _, out("s4") _, out("s5") _,
                options(nostack),
            );
        }
    }
}
