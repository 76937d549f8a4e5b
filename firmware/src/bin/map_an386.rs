//! What the maximum a posteriori costs on the target: six wheels at one instant. Run under `-icount shift=0`; an image of its
//! own, since the equations with their slopes fill the part.
#![no_std]
#![no_main]

use kapvik_board_an386::{bench::Bench, entry, exit};
use kapvik_firmware::fingerprint::SOILS;
use kapvik_firmware::identification::trial::{WHEEL, six_wheels, with_error};
use kapvik_firmware::identification::{SoilPrior, map};

#[entry]
fn main() -> ! {
    let bench = Bench::start();
    let [sand, ..] = SOILS;
    let Some(seen) = six_wheels(&sand) else { exit(1) };
    let prior = SoilPrior::usual();
    bench
        .kernel("map", -1.0, 1.0, |off| map::identify_up_to::<6, f32>(&WHEEL, &with_error(&seen, off), &prior).is_ok());
    exit(0)
}
