//! A recorded drive whose sensors fail: faults act on what the sensors said, not on the drive.

use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::simulate::faults::{Fault, Faults};

/// The frames that come, as the faults leave them.
pub fn failing(drive: &[(SensorFrame, Truth)], faults: Vec<Fault>) -> impl Iterator<Item = (SensorFrame, Truth)> + '_ {
    let mut faults = Faults::new(faults);
    drive.iter().filter_map(move |(frame, truth)| Some((faults.applied(frame)?, *truth)))
}
