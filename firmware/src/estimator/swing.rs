//! Whether the torque of a drive swings, as it does where grousers come to bear in turn.
//!
//! It then goes to and fro by more than ground makes it drift, a few frames each way, and no trend tells which way. That shows in what it
//! changes by over two frames, which is more than noise time after time. A jump, as of a wheel that is blocked or meets a rock, is more
//! than noise in a frame or two.

use crate::scalar::Scalar;

/// The share of a new change, squared, in the mean: 50 frames.
const SHARE: f64 = 0.02;
/// A mean change, squared, up to this many variances of the noise is no swinging. Noise alone makes it two with a spread of 0.4; on 120
/// drives over plane ground and hills none came so far. Rocks and new soils come so far in a few frames, and little is lost then.
const BY_NOISE: f64 = 4.5;
/// No change counts for more, in variances of the noise: a jump is no swinging.
const GREATEST: f64 = 12.0;

/// How much a torque swings.
#[derive(Debug, Clone, Copy)]
pub(super) struct Swing<S> {
    /// Mean change over two frames, squared, in variances of the noise.
    mean_square: S,
    /// The torques of the last frame and of the one before, N·m.
    last: [Option<S>; 2],
}

impl<S: Scalar> Swing<S> {
    /// It is still.
    pub fn new() -> Self {
        Self { mean_square: S::constant(2.0), last: [None; 2] }
    }

    /// Takes the torque of a frame, N·m, none where the drive is silent; and the standard deviation of its noise, N·m.
    pub fn take(&mut self, torque_nm: Option<S>, noise_std_nm: S) {
        let [last, before] = self.last;
        if let Some((now, before)) = torque_nm.zip(before) {
            let change = (now - before) / noise_std_nm;
            let square = (change * change).min(S::constant(GREATEST));
            self.mean_square += S::constant(SHARE) * (square - self.mean_square);
        }
        self.last = [torque_nm, last];
    }

    /// Whether it swings.
    pub fn swings(&self) -> bool {
        self.mean_square > S::constant(BY_NOISE)
    }
}

#[cfg(test)]
mod tests {
    use super::Swing;

    /// A sine of 0.2 N·m, seven frames long, changes over two frames by 0.31 N·m at most: its square is 20 variances of a noise of 0.05 N·m
    /// in the mean, of which seven or so count. Noise, a jump, and a climb by six times the noise in ten frames are no swinging.
    #[test]
    fn a_sine_swings_and_noise_a_jump_and_a_climb_do_not() {
        let noise = |frame: u32| if frame.is_multiple_of(2) { 0.05 } else { -0.05 };
        let mut swing = Swing::<f64>::new();
        let mut swings = |torque: f64| {
            swing.take(Some(torque), 0.05);
            swing.swings()
        };
        assert!((0..200).all(|frame| !swings(noise(frame / 4))));
        assert!((0..200).all(|frame| !swings(2.0 + noise(frame / 4))));
        assert!((0..200).all(|frame| !swings(2.0 + 0.03 * f64::from(frame) + noise(frame / 4))));
        let sine = |frame: u32| 8.0 + 0.2 * (f64::from(frame) * core::f64::consts::TAU / 7.0).sin();
        let noticed = (0..100).find(|frame| swings(sine(*frame))).expect("it swings");
        assert!((10..50).contains(&noticed), "{noticed}");
        assert!((noticed..200).all(|frame| swings(sine(frame + 1))));
    }
}
