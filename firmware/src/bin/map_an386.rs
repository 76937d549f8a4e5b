//! What the maximum a posteriori costs on the target: six wheels at one instant. Run under `-icount shift=0`; an image of its
//! own, since the flight image does not hold it.
#![no_std]
#![no_main]

use kapvik_board_an386::{bench::Bench, entry, exit};
use kapvik_firmware::fingerprint::SOILS;
use kapvik_firmware::identification::trial::{MAP, six_wheels, with_error};

#[entry]
fn main() -> ! {
    let bench = Bench::start();
    let [sand, ..] = &SOILS;
    let Some(seen) = six_wheels(sand) else { exit(1) };
    bench.kernel(MAP.name, -1.0, 1.0, |off| (MAP.call)(&with_error(&seen, off)).is_ok());
    bench.fingerprint(MAP.name, MAP.fingerprint());
    exit(0)
}
