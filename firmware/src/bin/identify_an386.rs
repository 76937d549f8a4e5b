//! What the methods of the literature cost on the target: six wheels at one instant. Run under `-icount shift=0`; an image of
//! its own, since the flight image holds none of them.
#![no_std]
#![no_main]

use kapvik_board_an386::{bench::Bench, entry, exit};
use kapvik_firmware::fingerprint::SOILS;
use kapvik_firmware::identification::trial::{LITERATURE, ONE_BY_ONE, WHEEL, recursive, six_wheels, with_error};

#[entry]
fn main() -> ! {
    let bench = Bench::start();
    let [sand, ..] = &SOILS;
    let (Some(seen), Ok(mut line)) = (six_wheels(sand), recursive()) else { exit(1) };
    // A line each: name, by how many standard deviations the first wheel's torque is off, the method.
    for method in &LITERATURE {
        bench.kernel(method.name, -1.0, 1.0, |off| (method.call)(&with_error(&seen, off)).is_ok());
    }
    let mut turn = seen.iter().cycle();
    bench.kernel(ONE_BY_ONE.name, -1.0, 1.0, |_| {
        let taken = turn.next().is_some_and(|one| line.add(&WHEEL, one).is_ok());
        (taken, line.identified().is_ok())
    });
    for method in LITERATURE.iter().chain([&ONE_BY_ONE]) {
        bench.fingerprint(method.name, method.fingerprint());
    }
    exit(0)
}
