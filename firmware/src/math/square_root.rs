//! The square root.

/// Square root, correctly rounded: 0.5 ulp.
///
/// Defined for every f32 of zero or more; −0 gives −0, ∞ gives ∞, a negative argument gives NaN.
#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
#[inline]
pub fn sqrt(x: f32) -> f32 {
    let root: f32;
    // SAFETY: one instruction from register to register, which neither reads nor writes memory nor touches the stack.
    // The hard-float calling convention of the target implies the floating-point unit that executes it. The flags are
    // not declared preserved, since it may set the inexact and the invalid flag.
    unsafe {
        core::arch::asm!("vsqrt.f32 {}, {}", out(sreg) root, in(sreg) x, options(pure, nomem, nostack));
    }
    root
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
