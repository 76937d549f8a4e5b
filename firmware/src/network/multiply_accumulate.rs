//! The innermost loop of a layer: weighted inputs added to a tile of sums.
//!
//! Each sum takes its inputs in their order, and each product is rounded before it is added. The target's chained
//! multiply-accumulate rounds twice as well, so that its loop, written out here because the compiler loads weights one by
//! one, gives the bits of the portable one.

/// Sums that are worked on at once: as many as stay in registers beside their operands.
pub const TILE: usize = 16;
/// Half of that, for the columns that a tile is too wide for.
pub const HALF: usize = TILE / 2;

#[cfg(target_arch = "arm")]
pub use on_target::{add_to_half, add_to_tile};
#[cfg(not(target_arch = "arm"))]
pub use portable::{add_to_half, add_to_tile};

/// For any machine.
#[cfg(not(target_arch = "arm"))]
mod portable {
    use super::{HALF, TILE};

    /// Adds to the sums in `tile` the products of the inputs with the weights in the columns from `place` · [`TILE`] on;
    /// leaves them as they are where a row is too short for that.
    #[inline]
    pub fn add_to_tile<const I: usize, const O: usize>(
        tile: &mut [f32; TILE],
        input: &[f32; I],
        rows: &[[f32; O]; I],
        place: usize,
    ) {
        let mut held = *tile;
        for (x, row) in input.iter().zip(rows) {
            if let Some(weights) = row.as_chunks::<TILE>().0.get(place) {
                held.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += x * weight);
            }
        }
        *tile = held;
    }

    /// The same for the [`HALF`] columns behind the last tile.
    #[inline]
    pub fn add_to_half<const I: usize, const O: usize>(half: &mut [f32; HALF], input: &[f32; I], rows: &[[f32; O]; I]) {
        let mut held = *half;
        for (x, row) in input.iter().zip(rows) {
            if let Some(weights) = row.as_chunks::<TILE>().1.first_chunk::<HALF>() {
                held.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += x * weight);
            }
        }
        *half = held;
    }
}

/// 1.3 instructions a product instead of three.
#[cfg(target_arch = "arm")]
mod on_target {
    use core::arch::asm;

    use super::{HALF, TILE};

    /// Adds a row of weights times the input in the register `$x` to the sums in s0 … s15, and moves on to the next row.
    macro_rules! add_row {
        ($x:literal) => {
            concat!(
                "vldmia {weights}!, {{s16-s23}}\n",
                add_row!($x: "s0" "s16", "s1" "s17", "s2" "s18", "s3" "s19", "s4" "s20", "s5" "s21", "s6" "s22", "s7" "s23"),
                "vldmia {weights}, {{s16-s23}}\n",
                add_row!($x: "s8" "s16", "s9" "s17", "s10" "s18", "s11" "s19", "s12" "s20", "s13" "s21", "s14" "s22", "s15" "s23"),
                "add {weights}, {weights}, {rest_of_row}\n",
            )
        };
        ($x:literal: $($sum:literal $weight:literal),+) => {
            concat!($("vmla.f32 ", $sum, ", ", $weight, ", ", $x, "\n"),+)
        };
    }

    /// See the portable one.
    #[inline]
    pub fn add_to_tile<const I: usize, const O: usize>(
        tile: &mut [f32; TILE],
        input: &[f32; I],
        rows: &[[f32; O]; I],
        place: usize,
    ) {
        if place >= O / TILE {
            return;
        }
        let rest_of_row = size_of::<[f32; O]>() - size_of::<[f32; TILE / 2]>();
        // SAFETY: the first tile of weights starts in the first row, and the last one, I − 1 rows further, ends at column
        // (place + 1) · TILE ≤ O of its row; `input` is I numbers long.
        unsafe {
            add_rows(tile, input.as_ptr(), I, rows.as_ptr().cast::<f32>().wrapping_add(place * TILE), rest_of_row)
        }
    }

    /// Adds `count` rows of a tile of weights, each times its input. One copy in the image for layers of all shapes.
    ///
    /// # Safety
    /// There are `count` inputs, and as many tiles of weights, each `rest_of_row` bytes behind the middle of the one before.
    #[inline(never)]
    unsafe fn add_rows(
        tile: &mut [f32; TILE],
        input: *const f32,
        count: usize,
        weights: *const f32,
        rest_of_row: usize,
    ) {
        // SAFETY: the inputs left over by fours one by one, then count / 4 times four, none if that is zero: as many inputs
        // and tiles of weights are read as the caller says there are. Reads and writes `tile`, which is borrowed for as
        // long, and no other memory. Changes only the registers and flags named.
        unsafe {
            asm!(
                "vldmia {sums}, {{s0-s15}}",
                "ands {turns}, {count}, #3",
                "beq 2f",
                "1: vldmia {input}!, {{s24}}",
                add_row!("s24"),
                "subs {turns}, {turns}, #1",
                "bne 1b",
                "2: lsrs {turns}, {count}, #2",
                "beq 4f",
                "3: vldmia {input}!, {{s24-s27}}",
                add_row!("s24"),
                add_row!("s25"),
                add_row!("s26"),
                add_row!("s27"),
                "subs {turns}, {turns}, #1",
                "bne 3b",
                "4: vstmia {sums}, {{s0-s15}}",
                sums = in(reg) tile.as_mut_ptr(),
                count = in(reg) count,
                turns = out(reg) _,
                input = inout(reg) input => _,
                weights = inout(reg) weights => _,
                rest_of_row = in(reg) rest_of_row,
                out("s0") _, out("s1") _, out("s2") _, out("s3") _, out("s4") _, out("s5") _, out("s6") _, out("s7") _,
                out("s8") _, out("s9") _, out("s10") _, out("s11") _, out("s12") _, out("s13") _, out("s14") _,
                out("s15") _, out("s16") _, out("s17") _, out("s18") _, out("s19") _, out("s20") _, out("s21") _,
                out("s22") _, out("s23") _, out("s24") _, out("s25") _, out("s26") _, out("s27") _,
                options(nostack),
            );
        }
    }

    /// See the portable one.
    #[inline]
    pub fn add_to_half<const I: usize, const O: usize>(half: &mut [f32; HALF], input: &[f32; I], rows: &[[f32; O]; I]) {
        let first = O - O % TILE;
        if I == 0 || first + HALF > O {
            return;
        }
        // SAFETY: there is an input, and the row of each ends no sooner than HALF weights behind its first of these;
        // `input` is I numbers long.
        unsafe {
            add_half_rows(
                half,
                input.as_ptr(),
                I,
                rows.as_ptr().cast::<f32>().wrapping_add(first),
                size_of::<[f32; O]>(),
            )
        }
    }

    /// Adds `count` rows of half a tile of weights, each times its input. One copy in the image, as small as it can be.
    ///
    /// # Safety
    /// There are `count` inputs, at least one, and as many half tiles of weights, each `row` bytes behind the one before.
    #[inline(never)]
    unsafe fn add_half_rows(half: &mut [f32; HALF], input: *const f32, count: usize, weights: *const f32, row: usize) {
        // SAFETY: as many inputs and half tiles of weights are read as the caller says there are. Reads and writes `half`,
        // which is borrowed for as long, and no other memory. Changes only the registers and flags named.
        unsafe {
            asm!(
                "vldmia {sums}, {{s0-s7}}",
                "1: vldmia {input}!, {{s16}}",
                "vldmia {weights}, {{s8-s15}}",
                add_row!("s16": "s0" "s8", "s1" "s9", "s2" "s10", "s3" "s11", "s4" "s12", "s5" "s13", "s6" "s14", "s7" "s15"),
                "add {weights}, {weights}, {row}",
                "subs {count}, {count}, #1",
                "bne 1b",
                "vstmia {sums}, {{s0-s7}}",
                sums = in(reg) half.as_mut_ptr(),
                count = inout(reg) count => _,
                input = inout(reg) input => _,
                weights = inout(reg) weights => _,
                row = in(reg) row,
                out("s0") _, out("s1") _, out("s2") _, out("s3") _, out("s4") _, out("s5") _, out("s6") _, out("s7") _,
                out("s8") _, out("s9") _, out("s10") _, out("s11") _, out("s12") _, out("s13") _, out("s14") _,
                out("s15") _, out("s16") _,
                options(nostack),
            );
        }
    }
}
