//! What a recording itself shows to be otherwise than the rover file or the agreement on its columns says.

use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::admitted::Admitted;
use super::camera_tilt::CameraTilt;
use super::dead_sensors::DeadSensors;
use super::gravity_felt::GravityFelt;
use super::gyro_felt::GyroFelt;
use super::joint_signs::JointSigns;
use super::never_together::NeverTogether;
use super::other_units;
use super::scatter::Scatter;
use super::still_clock::StillClock;
use super::weighing::Weighing;
use super::wheel_signs::WheelSigns;

/// All that looks at the frames of a drive beside the filters.
#[derive(Debug, Clone)]
pub struct Doubts {
    clock: StillClock,
    together: NeverTogether,
    dead: DeadSensors,
    weighing: Weighing,
    gravity: GravityFelt,
    gyro: GyroFelt,
    camera: CameraTilt,
    joints: JointSigns,
    signs: WheelSigns,
    scatter: Scatter,
    admitted: Admitted,
}

impl Doubts {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self {
            clock: StillClock::default(),
            together: NeverTogether::default(),
            dead: DeadSensors::of(rover),
            weighing: Weighing::of(rover),
            gravity: GravityFelt::of(rover),
            gyro: GyroFelt::of(rover),
            camera: CameraTilt::of(rover),
            joints: JointSigns::of(rover),
            signs: WheelSigns::of(rover),
            scatter: Scatter::of(rover),
            admitted: Admitted::of(rover),
        }
    }

    /// Takes the next frame. A clock, a dead sensor and one of other units are told by what the gates refuse; the others would take a failure,
    /// which the filters do not see, for how a healthy sensor is.
    pub fn take(&mut self, frame: &SensorFrame) {
        self.clock.take(frame);
        self.together.take(frame);
        self.dead.take(frame);
        self.gravity.take(frame);
        let Some(frame) = &self.admitted.of_frame(frame) else { return };
        self.weighing.take(frame);
        self.gyro.take(frame);
        self.camera.take(frame);
        self.joints.take(frame);
        self.signs.take(frame);
        self.scatter.take(frame);
    }

    /// What came of it: units, clock, rows, dead sensors, mass, gravity, signs, zeros, mounting, noise; a sentence each, without capital and stop. What may
    /// be why others are told comes first.
    pub fn told(self) -> Vec<String> {
        let units = other_units::told(self.admitted.spoken());
        let of_recording = [units, self.clock.told(), self.together.told(), self.dead.told()].into_iter().flatten();
        let weighed = self.weighing.misfit().map(|misfit| misfit.to_string());
        let gravity = self.gravity.other().map(|other| other.to_string());
        let of_body = of_recording.chain(weighed).chain(gravity).chain(self.gyro.told()).chain(self.camera.told());
        let of_body = of_body.chain(self.joints.told());
        let noisier = self.scatter.noisier();
        of_body.chain(self.signs.told()).chain(noisier.iter().map(ToString::to_string)).collect()
    }
}
