//! The longest message of each kind: every option there, every number as long as it gets.

use kapvik_firmware::estimator::{Estimate, EstimatorHealth, Sensor, SensorHealth, WheelActivity, WheelEstimate};
use kapvik_firmware::fusion::RoverSoil;
use kapvik_firmware::link::{
    FrameBuffer, Header, HealthReport, LinkHealth, PAYLOAD_CAPACITY, Reply, Request, WIRE_CAPACITY,
};
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::rover::{Axes, PerAxle, PerSide, PerWheel, Rover};
use kapvik_firmware::sensor_frame::{SensorFrame, WheelSensors};
use kapvik_firmware::soil::{ParameterEstimate, QueryAnswer, SoilEstimate};
use kapvik_firmware::terramechanics::Wheel;
use kapvik_firmware::wheel_state::{Slope, SoilQuery, WheelNoise, WheelState};
use serde::Serialize;

const NUMBER: f32 = f32::MAX;

fn on_wheels<T: Clone>(value: T) -> PerWheel<T> {
    PerSide::both(PerAxle::all(value))
}

fn soil() -> SoilEstimate {
    let parameter = ParameterEstimate {
        value: NUMBER,
        std: NUMBER,
        interval_68: [NUMBER; 2],
        interval_95: [NUMBER; 2],
        identifiable: true,
    };
    SoilEstimate {
        cohesion_pa: parameter,
        friction_angle_rad: parameter,
        shear_modulus_m: parameter,
        outside_training_range: true,
    }
}

fn query() -> SoilQuery {
    let state =
        WheelState { drawbar_pull_n: NUMBER, load_n: NUMBER, torque_nm: NUMBER, slip: NUMBER, sinkage_m: Some(NUMBER) };
    SoilQuery {
        wheel: Wheel { radius_m: NUMBER, width_m: NUMBER },
        noise: WheelNoise {
            drawbar_pull_n: NUMBER,
            load_n: NUMBER,
            torque_nm: NUMBER,
            slip: NUMBER,
            sinkage_m: NUMBER,
        },
        slope: Some(Slope { angle_rad: NUMBER, std_rad: NUMBER }),
        wheels: [state; 6].into_iter().collect(),
    }
}

fn sensor_frame() -> SensorFrame {
    let axes = Axes { x: Some(NUMBER), y: Some(NUMBER), z: Some(NUMBER) };
    SensorFrame {
        time_us: u64::MAX,
        wheels: on_wheels(WheelSensors {
            rate_rad_s: Some(NUMBER),
            motor_torque_nm: Some(NUMBER),
            load_cell_n: Some(NUMBER),
        }),
        bogie_angle_rad: PerSide::both(Some(NUMBER)),
        rocker_angle_rad: Some(NUMBER),
        accel_m_s2: axes,
        gyro_rad_s: axes,
        velocity_m_s: axes,
    }
}

fn frame_estimate() -> FrameEstimate {
    let estimate = Estimate { value: NUMBER, std: NUMBER };
    let wheel = WheelEstimate {
        activity: WheelActivity::Lifted,
        slip: Some(estimate),
        shared_slip_std: NUMBER,
        resistive_torque_nm: estimate,
        contact_angle_rad: estimate,
        normal_load_n: estimate,
        drawbar_pull_n: estimate,
        split_std_n: NUMBER,
        drawbar_pull_by_load_n: NUMBER,
    };
    FrameEstimate {
        time_us: u64::MAX,
        wheels: on_wheels(wheel),
        bogie_drawbar_pull_n: PerSide::both(estimate),
        wheel_soils: on_wheels(Ok(soil())),
        soil: Ok(RoverSoil { estimate: soil(), wheels: on_wheels(true), instants: NUMBER, changes: u16::MAX }),
    }
}

fn estimator_health() -> EstimatorHealth {
    let sensor = SensorHealth {
        missing: u16::MAX,
        not_finite: u16::MAX,
        out_of_range: u16::MAX,
        stuck: u16::MAX,
        surprising: u16::MAX,
        on_probation: u16::MAX,
        dropped: true,
    };
    EstimatorHealth {
        frames: u32::MAX,
        repeated_frames: u32::MAX,
        backward_frames: u32::MAX,
        gaps: u32::MAX,
        filter_resets: u32::MAX,
        relearned: u32::MAX,
        sensors: Sensor::all().map(|_| sensor),
    }
}

fn health() -> HealthReport {
    let link = LinkHealth {
        frames_ok: u32::MAX,
        oversized: u32::MAX,
        cut: u32::MAX,
        short: u32::MAX,
        checksum: u32::MAX,
        version: u32::MAX,
        undecodable: u32::MAX,
        sequence_gaps: u32::MAX,
        duplicates: u32::MAX,
        receive_errors: u32::MAX,
        replies_lost: u32::MAX,
    };
    HealthReport { link, queries_answered: u32::MAX, frames_taken: u32::MAX, stack_high_water_bytes: Some(u32::MAX) }
}

/// Bytes of a message in its frame before byte stuffing, from the bytes on the wire: these are the delimiter and one byte
/// of overhead for each run of 254 bytes more.
fn payload(message: &impl Serialize) -> usize {
    let wire = FrameBuffer::new().encode(Header::new(u16::MAX), message).expect("the longest message fits").len();
    let runs = (wire - 1).div_ceil(255);
    wire - 1 - runs
}

#[test]
fn the_longest_message_fits_and_little_room_is_wasted() {
    let requests = [Request::Estimate(query()), Request::Configure(Rover::assumed()), Request::Frame(sensor_frame())]
        .map(|request| payload(&request));
    let answer = QueryAnswer { wheels: [Ok(soil()); 6].into_iter().collect(), rover: Ok(soil()) };
    let replies = [
        Reply::Estimate(answer),
        Reply::Health(health()),
        Reply::EstimatorHealth(estimator_health()),
        Reply::Frame(Ok(frame_estimate())),
    ]
    .map(|reply| payload(&reply));
    println!("requests {requests:?}, replies {replies:?} bytes of {PAYLOAD_CAPACITY}; {WIRE_CAPACITY} on the wire");
    let longest = requests.into_iter().chain(replies).max().expect("there are messages");
    assert!((longest..longest + 64).contains(&PAYLOAD_CAPACITY), "the longest message has {longest} bytes");
}
