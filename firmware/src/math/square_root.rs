//! The square root.

/// Square root, correctly rounded: 0.5 ulp.
///
/// Defined for every f32 of zero or more; −0 gives −0, ∞ gives ∞, a negative argument gives NaN.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[inline]
pub fn sqrt(x: f32) -> f32 {
    let mut bits = x.to_bits();
    // SAFETY: three instructions between registers, which neither read nor write memory nor touch the stack; the one
    // register they use beside the operand is declared. The hard-float calling convention of the target implies the
    // floating-point unit that executes them. The flags are not declared preserved, since inexact and invalid may be set.
    unsafe {
        // Operands in floating-point registers would spare two moves, but the compiler takes these only for targets that
        // compute in double precision as well.
        core::arch::asm!(
            "vmov s0, {bits}",
            "vsqrt.f32 s0, s0",
            "vmov {bits}, s0",
            bits = inout(reg) bits,
            out("s0") _,
            options(pure, nomem, nostack)
        );
    }
    f32::from_bits(bits)
}

/// Square root, correctly rounded: 0.5 ulp.
///
/// Defined for every f32 of zero or more; −0 gives −0, ∞ gives ∞, a negative argument gives NaN.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline]
pub fn sqrt(x: f32) -> f32 {
    libm::sqrtf(x)
}

#[cfg(test)]
mod tests {
    use super::sqrt;

    #[test]
    fn special_values() {
        assert_eq!(sqrt(0.0).to_bits(), 0);
        assert_eq!(sqrt(-0.0).to_bits(), (-0.0_f32).to_bits());
        assert_eq!(sqrt(2.25), 1.5);
        assert_eq!(sqrt(f32::from_bits(2)), 2.0_f32.powi(-74));
        assert_eq!(sqrt(f32::INFINITY), f32::INFINITY);
        assert!(sqrt(-1.0).is_nan());
        assert!(sqrt(-f32::from_bits(1)).is_nan());
        assert!(sqrt(f32::NAN).is_nan());
    }
}
