//! Whether velocimeter and encoders speak in the same frames: slip is what they say of one instant.

use kapvik_firmware::sensor_frame::SensorFrame;

use super::raw_sensors::{LEAST_READINGS, NEARLY_ALL, wide};

/// In how many frames velocimeter, encoders and both spoke.
#[derive(Debug, Clone, Copy, Default)]
pub struct NeverTogether {
    velocimeter: u32,
    encoders: u32,
    both: u32,
}

impl NeverTogether {
    /// Takes the next frame.
    pub fn take(&mut self, frame: &SensorFrame) {
        let sees = wide(frame.velocity_m_s.x).is_some();
        let turns = frame.wheels.iter_wheels().any(|wheel| wide(wheel.rate_rad_s).is_some());
        self.velocimeter += u32::from(sees);
        self.encoders += u32::from(turns);
        self.both += u32::from(sees && turns);
    }

    /// What came of it, without capital and stop.
    pub fn told(&self) -> Option<String> {
        let Self { velocimeter, encoders, both } = *self;
        let seldomer = velocimeter.min(encoders);
        let is_seldom = f64::from(both) <= (1.0 - NEARLY_ALL) * f64::from(seldomer);
        (seldomer >= LEAST_READINGS && is_seldom).then(|| {
            format!(
                "velocimeter and encoders speak in the same frame {both} of {seldomer} times: slip is what they say of one instant, and \
                 without it slip and soil are poorly known; give rows of one instant times that are closer together"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of frames in the n-th of which the velocimeter, and the encoders, speak.
    fn told(frames: u32, sees: impl Fn(u32) -> bool, turns: impl Fn(u32) -> bool) -> Option<String> {
        let mut together = NeverTogether::default();
        for number in 0..frames {
            let mut frame = SensorFrame::default();
            frame.velocity_m_s.x = Some(0.02).filter(|_| sees(number));
            frame.wheels.left.rear.rate_rad_s = Some(0.3).filter(|_| turns(number));
            together.take(&frame);
        }
        together.told()
    }

    #[test]
    fn sensors_that_take_turns_are_told_of() {
        let (even, odd) = (|number| number % 2 == 0, |number| number % 2 == 1);
        let said = told(200, even, odd).expect("never together");
        assert!(said.starts_with("velocimeter and encoders speak in the same frame 0 of 100 times"), "{said}");
        assert_eq!(told(80, even, odd), None, "too few frames tell nothing");
        assert_eq!(told(500, |number| number % 5 == 0, |_| true), None, "a seldom camera");
        assert_eq!([told(200, |_| false, |_| true), told(200, |_| true, |_| false)], [None, None]);
    }
}
