//! Drives of the simulator, each driven once a binary, however many tests look at it.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use kapvik_firmware::rover::Rover;
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::truth_file::Truth;
use kapvik_host::simulate::{Options, Scenario, Traverse};

/// The frames of a drive to its end, each with what was true.
pub type Recording = Arc<Vec<(SensorFrame, Truth)>>;

/// The drive of a rover.
pub fn recorded(scenario: Scenario, seed: u64, rover: &Rover<f64>, options: &Options) -> Recording {
    static RECORDED: Mutex<BTreeMap<String, Arc<OnceLock<Recording>>>> = Mutex::new(BTreeMap::new());
    // Numbers are written to the last bit: what is written alike is the same drive.
    let asked = format!("{scenario:?} {seed} {rover:?} {options:?}");
    let drive = RECORDED.lock().expect("nothing fails under this lock").entry(asked).or_default().clone();
    // No longer under the lock: other drives go on meanwhile.
    let record = || {
        let traverse = Traverse::new(scenario, seed, rover, options).expect("there is such a drive");
        Arc::new(traverse.run().expect("the rover drives on"))
    };
    drive.get_or_init(record).clone()
}
