//! Refusals in words.

use kapvik_firmware::{identification, soil};

/// Why a method of the literature gives no answer.
pub fn method_refusal(refusal: identification::Refusal) -> String {
    use identification::Refusal;
    match refusal {
        Refusal::TooFew { needed } => format!("too few observations that the method can use: it needs {needed}"),
        Refusal::TooMany { room } => format!("too many observations: the method has room for {room}"),
        Refusal::NoSinkage => "a wheel without sinkage, which the method needs".to_owned(),
        Refusal::NotFinite => "a number is not finite".to_owned(),
        Refusal::OutOfRange => "a number is outside the range that the method takes".to_owned(),
        Refusal::NegativeStress => "a stress comes out at zero or below".to_owned(),
        Refusal::NotIdentifiable => {
            "the observations are too alike: what distinguishes them is below their noise".to_owned()
        }
        Refusal::NotConverged => "the iteration did not settle".to_owned(),
        Refusal::NoSoilFits => "none of the soils that the method chooses from carries the wheels".to_owned(),
    }
}

/// Why a network gives no answer.
pub fn network_refusal(refusal: soil::Refusal) -> &'static str {
    use soil::Refusal;
    match refusal {
        Refusal::NoWheels => "there is no wheel",
        Refusal::NotFinite => "a number is not finite",
        Refusal::OutOfRange => "a number is outside the range that the networks take",
        Refusal::NotRolling => "no wheel rolls under load with a slip that is known",
        Refusal::SelfTestFailed => "the flight computer's self-test failed",
    }
}
