//! What a recording itself shows to be otherwise than the rover file or the agreement on its columns says.

use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;

use super::camera_tilt::CameraTilt;
use super::gravity_felt::GravityFelt;
use super::gyro_felt::GyroFelt;
use super::joint_signs::JointSigns;
use super::scatter::Scatter;
use super::weighing::Weighing;
use super::wheel_signs::WheelSigns;

/// All that looks at the frames of a drive beside the filters.
#[derive(Debug, Clone)]
pub struct Doubts {
    weighing: Weighing,
    gravity: GravityFelt,
    gyro: GyroFelt,
    camera: CameraTilt,
    joints: JointSigns,
    signs: WheelSigns,
    scatter: Scatter,
}

impl Doubts {
    /// Of a rover, before its first frame.
    pub fn of(rover: &Rover<f32>) -> Self {
        Self {
            weighing: Weighing::of(rover),
            gravity: GravityFelt::of(rover),
            gyro: GyroFelt::of(rover),
            camera: CameraTilt::of(rover),
            joints: JointSigns::of(rover),
            signs: WheelSigns::of(rover),
            scatter: Scatter::of(rover),
        }
    }

    /// Takes the next frame.
    pub fn take(&mut self, frame: &SensorFrame) {
        self.weighing.take(frame);
        self.gravity.take(frame);
        self.gyro.take(frame);
        self.camera.take(frame);
        self.joints.take(frame);
        self.signs.take(frame);
        self.scatter.take(frame);
    }

    /// What came of it: mass, gravity, signs, zeros, mounting, noise; a sentence each, without capital and stop.
    pub fn told(self) -> Vec<String> {
        let weighed = self.weighing.misfit().map(|misfit| misfit.to_string());
        let gravity = self.gravity.other().map(|other| other.to_string());
        let of_body = weighed.into_iter().chain(gravity).chain(self.gyro.told()).chain(self.camera.told());
        let of_body = of_body.chain(self.joints.told());
        let noisier = self.scatter.noisier();
        of_body.chain(self.signs.told()).chain(noisier.iter().map(ToString::to_string)).collect()
    }
}
