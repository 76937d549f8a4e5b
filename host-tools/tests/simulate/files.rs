//! Rover files and frame files: what they may say, and how mistakes are told.

use std::fs;
use std::path::Path;

use kapvik_firmware::rover::{Planar, Rover};
use kapvik_firmware::sensor_frame::SensorFrame;
use kapvik_host::data::frame_file::{FrameReader, write_frame, write_header};
use kapvik_host::data::number_stream::NumberStream;
use kapvik_host::data::rover_file::RoverFile;
use kapvik_host::data::sensor_channels::{values, values_mut};
use kapvik_host::data::text::TextFile;
use kapvik_host::data::toml_file::TomlFile;
use kapvik_host::data::truth_file::{self, TruthReader};
use kapvik_host::simulate::{Options, Scenario};
use proptest::prelude::{Strategy, any, proptest};

use super::drive;

fn rover(text: &str) -> Result<Rover<f64>, String> {
    let file = TomlFile::new(TextFile::new(Path::new("r.toml"), text));
    RoverFile::parse(&file).map(|file| file.rover).map_err(|error| error.to_string())
}

fn frames(text: impl AsRef<[u8]>) -> Result<Vec<SensorFrame>, String> {
    let bytes = std::io::Cursor::new(text.as_ref().to_vec());
    let stream = NumberStream::new(Path::new("f.csv"), Box::new(bytes)).and_then(FrameReader::new);
    stream.and_then(Iterator::collect).map_err(|error| error.to_string())
}

#[test]
fn what_a_rover_file_leaves_out_is_assumed() {
    assert_eq!(rover(""), Ok(Rover::assumed()));
    assert_eq!(rover("title = \"K0\"\n[author]\nname = \"NN\"\n"), Ok(Rover::assumed()), "it may say more");
    let lighter =
        rover("mass_kg = 30\n[suspension]\nfront_hub = [0.40, -0.20]\n[noise]\nload_cell_n = 1.5\n").expect("a rover");
    assert_eq!((lighter.mass_kg, lighter.noise.load_cell_n), (30.0, 1.5));
    assert_eq!(lighter.suspension.front_hub, Planar { x: 0.40, z: -0.20 });
    assert_eq!(lighter.suspension.rear_hub, Rover::<f64>::assumed().suspension.rear_hub);
}

#[test]
fn what_is_assumed_is_named() {
    let text = "mass_kg = 41.0\n[wheel]\nradius_m = 0.1\n[drive]\nreflected_inertia_kg_m2 = 2.0\n[noise]\n";
    let file = TomlFile::new(TextFile::new(Path::new("r.toml"), text));
    let assumed = RoverFile::parse(&file).expect("a rover").assumed;
    assert_eq!(assumed.to_string(), "gravity_m_s2, wheel.width_m, [suspension], [noise]");
}

/// The rover file of the project's contract, key by key, is the assumed set.
#[test]
fn the_assumed_set_is_that_of_the_contract() {
    let text = "mass_kg = 41.0\ngravity_m_s2 = 9.81\n[wheel]\nradius_m = 0.075\nwidth_m = 0.070\n\
        grouser_height_m = 0.005\ngrouser_count = 24\n[suspension]\nfront_hub = [0.35, -0.20]\n\
        bogie_pivot = [-0.175, -0.10]\nmiddle_hub = [0.175, -0.10]\nrear_hub = [-0.175, -0.10]\nhalf_track = 0.355\n\
        centre_of_mass = [0.0, 0.0, 0.05]\n[drive]\nreflected_inertia_kg_m2 = 2.1\n[noise]\nwheel_rate_rad_s = 0.002\n\
        motor_torque_nm = 0.05\nload_cell_n = 0.5\nangle_rad = 0.001\naccel_m_s2 = 0.02\ngyro_rad_s = 0.001\n\
        velocity_m_s = 0.0005\n";
    let file = TomlFile::new(TextFile::new(Path::new("r.toml"), text));
    let (said, assumed) = (RoverFile::parse(&file).expect("a rover"), RoverFile::assumed());
    assert_eq!((said.rover, said.grousers), (assumed.rover, assumed.grousers));
    assert!(said.assumed.are_none() && assumed.assumed.are_all());
}

#[test]
fn impossible_rovers_are_refused_at_the_key_to_blame() {
    for (text, expected) in [
        ("mass_kg = -41.0\n", "r.toml:1:11: no rover weighs this"),
        ("mass_kg = 41.0\ngravity_m_s2 = 0\n", "r.toml:2:16: no rover weighs this"),
        ("[wheel]\nwidth_m = nan\n", "r.toml:2:11: no wheel has this size"),
        ("[wheel]\ngrouser_height_m = -1\n", "r.toml:2:20: grouser_height_m = -1"),
        ("[suspension]\nhalf_track = 0\n", "r.toml:2:14: the suspension is nowhere"),
        ("[suspension]\nmiddle_hub = [inf, -0.1]\n", "r.toml:2:14: the suspension is nowhere"),
        ("[suspension]\ncentre_of_mass = [0.0, nan, 0.0]\n", "r.toml:2:18: the suspension is nowhere"),
        ("[suspension]\nfront_hub = [-0.1, -0.2]\n", "r.toml:2:13: the hubs are out of order"),
        ("[suspension]\nrear_hub = [0.1, -0.1]\n", "r.toml:2:12: the bogie would not stand"),
        ("[suspension]\nfront_hub = [0.35, -0.2]\nrear_hub = [-0.175, 0.1]\n", "r.toml:3:12: drawbar pull would"),
        ("[suspension]\ncentre_of_mass = [1.0, 0.0, 0.0]\n", "r.toml:2:18: the rover would not stand"),
        ("[drive]\nreflected_inertia_kg_m2 = 0\n", "r.toml:2:27: no drive has this inertia"),
        ("[noise]\nload_cell_n = 0.5\ngyro_rad_s = 0\n", "r.toml:3:14: no sensor has this noise"),
        // The key whose value is wrong, wherever it stands among others that are right.
        (
            "[suspension]\nfront_hub = [0.35, -0.2]\nrear_hub = [0.175, -0.1]\n",
            "r.toml:3:12: the hubs are out of order",
        ),
        (
            "[suspension]\nfront_hub = [0.35, -0.2]\nbogie_pivot = [0.5, -0.1]\n",
            "r.toml:3:15: the hubs are out of order",
        ),
        ("[suspension]\nbogie_pivot = [0.1, -0.1]\ncentre_of_mass = [0, 0, 0.05]\n", "r.toml:2:15: "),
        ("[noise]\ngyro_rad_s = 0\nload_cell_n = -1\n", "r.toml:2:14: no sensor has this noise"),
        ("gravity_m_s2 = 981\n", "r.toml:1:16: no rover drives there"),
        ("[wheel]\nradius_m = 0.5\n", "r.toml:2:12: two wheels of a side"),
        ("[suspension]\nmiddle_hub = [0.5, -0.1]\n", "r.toml:2:14: two wheels of a side"),
        ("[suspension]\nhalf_track = 0.02\n", "r.toml:2:14: the wheels of both sides"),
        ("[suspension]\ncentre_of_mass = [0, 0, 50]\n", "r.toml:2:18: nothing is so heavy there"),
        ("[suspension]\ncentre_of_mass = [0, 0, -5]\n", "r.toml:2:18: nothing is so heavy there"),
        ("[wheel]\ngrouser_height_m = 5\n", "r.toml:2:20: no wheel has such grousers"),
        // What is no number in those of the flight computer.
        ("mass_kg = 1e-50\n", "r.toml:1:11: no rover weighs this"),
        ("[noise]\nload_cell_n = 1e300\n", "r.toml:2:15: no sensor has this noise"),
        ("[suspension]\nfront_hub = [0.35]\n", "r.toml:2:13: "),
        ("mass = 41.0\n", "r.toml:1:1: unknown field `mass`"),
        ("half_track = 0.4\n", "r.toml:1:1: unknown field `half_track`: is `half_track` of a table meant?"),
        ("[suspension]\nrear_hubs = [0, 0]\n", "r.toml:2:1: unknown field `rear_hubs`"),
        ("mass_kg = \"heavy\"\n", "r.toml:1:11: invalid type"),
        ("mass_kg = = 1\n", "r.toml:1:11: "),
        ("wheel = 0.075\n", "r.toml:1:9: invalid type: floating point `0.075`, expected a table"),
    ] {
        let said = rover(text).expect_err(text);
        assert!(said.starts_with(expected) && said.lines().count() == 1, "{text}\n{said}");
    }
}

#[test]
fn frames_are_read_as_they_are_written() {
    let text = "\u{feff}t_s,note,load_cell_fl_n,gyro_z_rad_s\r\n0,\"a, b\",65.5,\r\n\r\n0.1,, NaN ,-inf\r\n";
    let found = frames(text).expect("frames");
    assert_eq!(found.len(), 2);
    assert_eq!((found[0].wheels.left.front.load_cell_n, found[0].gyro_rad_s.z), (Some(65.5), None));
    assert_eq!(found[1].time_us, 100_000);
    assert!(
        found[1].wheels.left.front.load_cell_n.is_some_and(f32::is_nan),
        "a value, for the flight software to refuse"
    );
    assert_eq!(found[1].gyro_rad_s.z, Some(f32::NEG_INFINITY));
    assert_eq!(found[1].rocker_angle_rad, None, "no column, no sensor");
    let misspelt = frames("t_s,accel_x_m_s2,load_cell_fl\n0,0,65\n").expect_err("a sensor without its unit");
    assert_eq!(misspelt, "f.csv:1:3: `load_cell_fl` is no sensor: is `load_cell_fl_n` meant?");
    let none = frames("t_s,accel_x_m_s2\n").expect_err("no frame");
    assert_eq!(none, "f.csv:2:1: no frame: expected one below the header");
}

#[test]
fn frames_that_are_wrong_are_refused_by_line_and_column() {
    let cases: [(&[u8], &str); 18] = [
        (b"", "f.csv:1:1: the file is empty"),
        (b"load_cell_fl_n\n1\n", "f.csv:1:1: no column `t_s`"),
        (b"t_s;load_cell_fl_n\n0;1\n", "f.csv:1:1: columns are parted by semicolons: expected commas"),
        (b"t_s,load_cell_xx_n\n0,1\n", "f.csv:1:1: no sensor: expected columns such as"),
        (b"t_s,gyro_x_rad_s,gyro_x_rad_s\n0,1,1\n", "f.csv:1:3: a second column is named `gyro_x_rad_s`"),
        (b"t_s,,gyro_x_rad_s\n0,1,1\n", "f.csv:1:2: this column has no name"),
        (b"t_s,gyro_x_rad_s\n0,1\n0.1,fast\n", "f.csv:3:2: gyro_x_rad_s: `fast`: expected a number"),
        (b"t_s,gyro_x_rad_s\n0,1\n\n\r\n0.1,1,2\n", "f.csv:5:3: 3 fields in this row: expected 2"),
        (b"t_s,gyro_x_rad_s\n0\n", "f.csv:2:2: 1 fields in this row: expected 2"),
        (b"t_s,gyro_x_rad_s\n,1\n", "f.csv:2:1: t_s: empty"),
        (b"t_s,gyro_x_rad_s\nnoon,1\n", "f.csv:2:1: t_s: `noon`"),
        (b"t_s,gyro_x_rad_s\n-1,1\n", "f.csv:2:1: t_s: -1: expected a time of 0 s or more"),
        (b"t_s,gyro_x_rad_s\nnan,1\n", "f.csv:2:1: t_s: NaN: expected a time of 0 s or more"),
        (b"t_s,gyro_x_rad_s\n1e300,1\n", "f.csv:2:1: t_s: 1000"),
        (b"t_s,gyro_x_rad_s\r\n0.2,1\r\n0.1,1\r\n", "f.csv:3:1: t_s: 0.1: time runs backwards"),
        (b"t_s,gyro_x_rad_s\n0,\xff\n", "f.csv:2:2: this byte is not UTF-8"),
        (b"t_s,gyro_x_rad_s\n0,\"1\n", "f.csv:2:2: a quote is not closed"),
        (b"t_s,gyro_x_rad_s\n0,1\r0.1,1\n", "f.csv:2:2: a line ends in a carriage return alone"),
    ];
    for (text, expected) in cases {
        let said = frames(text).expect_err(expected);
        assert!(said.starts_with(expected) && said.lines().count() == 1, "{said}");
    }
    // A frame that comes twice is the estimator's to leave out, and to count.
    assert_eq!(frames(b"t_s,gyro_x_rad_s\n0.2,1\n0.2,1\n").map(|frames| frames.len()), Ok(2));
    // Each row before a mistake has been given by then.
    let bytes = std::io::Cursor::new(b"t_s,gyro_x_rad_s\n0,1\n0.1,x\n".to_vec());
    let mut reader =
        FrameReader::new(NumberStream::new(Path::new("f.csv"), Box::new(bytes)).expect("a table")).expect("frames");
    assert!(reader.next().is_some_and(|frame| frame.is_ok()) && reader.next().is_some_and(|frame| frame.is_err()));
}

/// A row of zeros without an end is no table, and is not read into memory to find out.
#[test]
fn a_row_that_does_not_end_is_refused() {
    let said = NumberStream::new(Path::new("f.csv"), Box::new(std::io::BufReader::new(std::io::repeat(b'0'))));
    let said = said.err().expect("refused").to_string();
    assert!(said.starts_with("f.csv:1:1: this row does not end"), "{said}");
}

fn any_frame() -> impl Strategy<Value = SensorFrame> {
    let readings = proptest::collection::vec(any::<Option<u32>>(), 30);
    (0..=2_147_483_648_000_000_u64, readings).prop_map(|(time_us, readings)| {
        let mut frame = SensorFrame { time_us, ..SensorFrame::default() };
        for (value, bits) in values_mut(&mut frame).zip(readings) {
            *value = bits.map(f32::from_bits);
        }
        frame
    })
}

proptest! {
    /// Every time and every f32 comes back, but for the payload of a NaN.
    #[test]
    fn every_frame_comes_back(frame in any_frame()) {
        let mut text = Vec::new();
        write_header(&mut text).expect("written");
        write_frame(&mut text, &frame).expect("written");
        let found = frames(text).expect("frames")[0];
        assert_eq!(found.time_us, frame.time_us);
        for (found, written) in values(&found).into_iter().zip(values(&frame)) {
            let both_nan = found.is_some_and(f32::is_nan) && written.is_some_and(f32::is_nan);
            assert!(both_nan || found.map(f32::to_bits) == written.map(f32::to_bits), "{found:?} {written:?}");
        }
    }
}

#[test]
fn the_columns_of_the_truth_are_those_that_were_agreed() {
    let mut text = Vec::new();
    truth_file::write_header(&mut text).expect("written");
    let text = String::from_utf8(text).expect("text");
    let header: Vec<&str> = text.trim_end().split(',').collect();
    for name in [
        "t_s",
        "slip_fl",
        "resistive_torque_ml_nm",
        "contact_angle_rl_rad",
        "normal_load_fr_n",
        "drawbar_pull_mr_n",
        "sinkage_rr_m",
        "cohesion_pa",
        "friction_angle_rad",
        "shear_modulus_m",
    ] {
        assert_eq!(header.iter().filter(|column| **column == name).count(), 1, "{name}");
    }
    // The time; of each wheel seven quantities and the five of its soil; the soil, and where the body is.
    assert_eq!(header.len(), 1 + 6 * (7 + 5) + 5 + 4);
}

#[test]
fn truths_come_back() {
    let rows = drive(Scenario::Traverse, 2, &Options { duration_s: Some(5.0), ..Options::default() });
    let mut text = Vec::new();
    truth_file::write_header(&mut text).expect("written");
    rows.iter().for_each(|(_, truth)| truth_file::write_truth(&mut text, truth).expect("written"));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.truth.csv");
    fs::write(&path, text).expect("written");
    let found: Vec<_> = TruthReader::open(&path).expect("truths").map(|truth| truth.expect("a truth")).collect();
    assert!(found.iter().eq(rows.iter().map(|(_, truth)| truth)), "to the bit");
    fs::write(&path, "t_s,x_m\n0.2,0\n0.1,0\n").expect("written");
    let said = TruthReader::open(&path).expect("truths").find_map(Result::err).expect("refused").to_string();
    assert!(
        said.ends_with("a.truth.csv:3:1: t_s: 0.1: time runs backwards: expected no earlier time than before"),
        "{said}"
    );
}
