//! Tests that span the firmware and the host tools; see the files beside this one. Here is what they share.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use kapvik_firmware::link::{FrameBuffer, Header, Reply};
use kapvik_firmware::rover::Rover;
use kapvik_firmware::soil::QueryAnswer;
use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::{Slope, SoilQuery, WheelNoise, WheelState};
use kapvik_host::data::frame_file::FrameReader;
use kapvik_host::error::HostError;
use kapvik_host::flight_computer::FlightComputer;
use kapvik_host::qemu::{Binary, Image, LogView};
use kapvik_host::replay::{EstimateWriter, replay};
use kapvik_host::setup::{self, Toolchain};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Deserialize;

/// What the images are built and run with.
///
/// # Panics
/// Where it is missing.
pub fn toolchain() -> &'static Toolchain {
    static TOOLCHAIN: OnceLock<Toolchain> = OnceLock::new();
    TOOLCHAIN.get_or_init(|| setup::prepare_quietly().unwrap_or_else(|error| panic!("{error}")))
}

/// The flight image.
///
/// # Panics
/// Where it does not build.
pub fn flight_image() -> &'static Image {
    static IMAGE: OnceLock<Image> = OnceLock::new();
    IMAGE.get_or_init(|| Image::build(toolchain(), Binary::Flight).unwrap_or_else(|error| panic!("{error}")))
}

/// The flight image, started in QEMU.
///
/// # Panics
/// Where it does not start.
pub fn flight_computer() -> FlightComputer {
    FlightComputer::in_qemu(toolchain(), flight_image(), LogView::Nothing).unwrap_or_else(|error| panic!("{error}"))
}

/// A source of the same numbers at each run.
pub fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// Queries such as a rover sends: one to six wheels of about Kapvik's size, with and without sinkage, 20 to 120 N a wheel.
pub fn queries(count: usize, random: &mut ChaCha8Rng) -> Vec<SoilQuery> {
    (0..count).map(|_| query(random)).collect()
}

fn query(random: &mut ChaCha8Rng) -> SoilQuery {
    let wheel = Wheel { radius_m: random.random_range(0.05..0.16), width_m: random.random_range(0.05..0.17) };
    let averaged = f32::from(random.random_range(1_u8..=10));
    let noise = WheelNoise {
        drawbar_pull_n: 1.0 / averaged,
        load_n: 0.5 / averaged,
        torque_nm: 0.05 / averaged,
        slip: 0.01 / averaged,
        sinkage_m: 0.001 / averaged,
    };
    let count = random.random_range(1..=6);
    let wheels = (0..count).map(|_| state(&wheel, random)).collect();
    let slope = random.random_bool(0.5).then(|| Slope { angle_rad: random.random_range(-0.3..0.3), std_rad: 0.0175 });
    SoilQuery { wheel, noise, slope, wheels }
}

fn state(wheel: &Wheel<f32>, random: &mut ChaCha8Rng) -> WheelState {
    let load_n = random.random_range(20.0..120.0);
    WheelState {
        drawbar_pull_n: load_n * random.random_range(-0.2..0.6),
        load_n,
        torque_nm: load_n * wheel.radius_m * random.random_range(0.1..0.8),
        slip: random.random_range(-0.3..0.95),
        sinkage_m: random.random_bool(0.5).then(|| wheel.radius_m * random.random_range(0.01..0.5)),
    }
}

/// The same query with one of its numbers replaced by one that cannot be.
pub fn spoiled(mut query: SoilQuery, random: &mut ChaCha8Rng) -> SoilQuery {
    const IMPOSSIBLE: [f32; 4] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e30];
    let value = IMPOSSIBLE.get(random.random_range(0..IMPOSSIBLE.len())).copied().unwrap_or(f32::NAN);
    let place = random.random_range(0..6_u8);
    match (place, query.wheels.first_mut()) {
        (0, _) => query.wheel.radius_m = value,
        (1, _) => query.noise.torque_nm = value,
        (2, Some(state)) => state.load_n = value,
        (3, Some(state)) => state.slip = value,
        (4, Some(state)) => state.sinkage_m = Some(value),
        _ => query.wheels.clear(),
    }
    query
}

/// Bytes without any order in them.
pub fn noise_bytes(count: usize, random: &mut ChaCha8Rng) -> Vec<u8> {
    let mut bytes = vec![0; count];
    random.fill_bytes(&mut bytes);
    bytes
}

/// The bits of an answer: two that differ in as much as the sign of a zero give different bytes.
///
/// # Panics
/// Where the answer does not fit a frame.
pub fn bits(answer: &QueryAnswer) -> Vec<u8> {
    let mut buffer = FrameBuffer::new();
    buffer.encode(Header::new(1), &Reply::Estimate(answer.clone())).expect("an answer fits a frame").to_vec()
}

/// The recorded drive that lies beside these tests: 20 s of hills, with sensors that give nothing, NaN and a million.
pub fn recorded_drive() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("replay/frames.csv")
}

/// The file of estimates that a flight computer makes of the recorded drive, for the assumed rover.
///
/// # Panics
/// Where the computer does not answer.
pub fn estimates_of_the_recorded_drive(computer: &mut FlightComputer) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut writer = EstimateWriter::new(&mut bytes).expect("memory takes everything");
    let frames = FrameReader::open(&recorded_drive()).unwrap_or_else(|error| panic!("{error}"));
    let take = |estimate: &_| writer.write(estimate).map_err(|error| HostError::Failed(error.to_string()));
    replay(computer, &Rover::assumed(), frames, take).unwrap_or_else(|error| panic!("{error}"));
    bytes
}

/// What the target may cost: `budgets.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budgets {
    /// Of the flight image.
    pub image: ImageBudget,
    /// The most instructions of each function.
    pub instructions: BTreeMap<String, u64>,
}

/// The memory that the flight image may take.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageBudget {
    /// Program memory.
    pub flash_bytes: u32,
    /// Static variables and the deepest stack together.
    pub ram_bytes: u32,
}

/// Reads the budgets.
///
/// # Panics
/// Where the file is not as it should be.
pub fn budgets() -> Budgets {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("budgets.toml");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    toml::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
