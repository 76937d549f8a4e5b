//! Freezes the trained networks into the library: reads the table, proves that it is whole, fits and computes what it
//! promises, and writes it out as `static` data.

#[path = "src/checksum.rs"]
#[allow(dead_code)] // the firmware sums more than tables
mod checksum;
#[path = "src/math/mod.rs"]
#[allow(dead_code, unused_imports)] // the networks need only a part of it
mod math;
#[path = "src/network/mod.rs"]
#[allow(dead_code, unused_imports)] // what the flight side needs beyond running a network
mod network;

use std::path::{Path, PathBuf};
use std::process::exit;
use std::{env, fs};

use kapvik_table_file::TableFile;
use network::{FLOWN_PAIRS, GOLDEN_PAIRS, PartVisitor, RoverTable, WheelTable, Words, checksum};

/// Names another table than the one in the source tree; `none` builds without one, to train the first of a new shape.
const OVERRIDE: &str = "KAPVIK_WEIGHTS";

fn main() {
    println!("cargo::rerun-if-env-changed={OVERRIDE}");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/checksum.rs");
    println!("cargo::rerun-if-changed=src/network");
    println!("cargo::rerun-if-changed=src/math");
    println!("cargo::rerun-if-changed=../memory.x");
    if let Err(message) = manifest_folder().and_then(|folder| link_search(&folder).and_then(|()| freeze(&folder))) {
        println!("cargo::error={message}");
        exit(1);
    }
}

fn manifest_folder() -> Result<PathBuf, String> {
    env::var("CARGO_MANIFEST_DIR").map(PathBuf::from).map_err(|error| error.to_string())
}

/// Lays the image out as the workspace's `memory.x` says. Here and not in the configuration of cargo, where the
/// environment variable `RUSTFLAGS` would silently replace it.
fn link_search(here: &Path) -> Result<(), String> {
    let workspace = here.parent().ok_or("the package is not inside the workspace")?;
    println!("cargo::rustc-link-search={}", workspace.display());
    if env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("none") {
        println!("cargo::rustc-link-arg-bins=-Tlink.x");
        println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    }
    Ok(())
}

fn freeze(here: &Path) -> Result<(), String> {
    let (mut wheel, mut rover) = (<WheelTable>::ZERO, <RoverTable>::ZERO);
    let mut file_crc = None;
    let chosen = env::var(OVERRIDE).ok();
    let trained = chosen.as_deref() != Some("none");
    if trained {
        let path = chosen.map_or_else(|| here.join("weights/kapvik.table"), PathBuf::from);
        println!("cargo::rerun-if-changed={}", path.display());
        let in_file = |message: String| format!("{}: {message}", path.display());
        let bytes = fs::read(&path).map_err(|error| in_file(error.to_string()))?;
        file_crc = Some(kapvik_table_file::checksum(&bytes));
        let file = TableFile::parse(&bytes).map_err(|error| in_file(error.to_string()))?;
        fill(&file, &mut wheel, &mut rover).map_err(in_file)?;
        prove(&wheel, &rover).map_err(in_file)?;
    }
    let out = env::var("OUT_DIR").map_err(|error| error.to_string())?;
    write(&Path::new(&out).join("frozen.rs"), file_crc, &wheel.flown(), &rover.flown())
}

/// Takes numbers from a file, part by part; keeps the first thing that does not fit.
struct Fill<'a> {
    file: &'a TableFile,
    wrong: Option<String>,
}

impl Fill<'_> {
    /// Fills a part from the block of its name; what it says of a block that does not fit.
    fn fill(&self, name: &str, shape: &[usize], numbers: &mut impl Words) -> Result<&[u32], String> {
        let mut count = 0;
        numbers.for_each(&mut |_| count += 1);
        let block = self.file.block(name).ok_or_else(|| format!("the frozen table has no block {name}"))?;
        if block.shape != shape || block.words.len() != count {
            return Err(format!(
                "block {name} of the frozen table has shape {:?} and {} numbers, this build needs {shape:?} and {count}",
                block.shape,
                block.words.len()
            ));
        }
        let mut words = block.words.iter();
        numbers.for_each_mut(&mut |place| *place = words.next().copied().unwrap_or(0));
        Ok(&block.words)
    }
}

impl PartVisitor for Fill<'_> {
    fn part(&mut self, name: &'static str, shape: &[usize], numbers: &mut impl Words) {
        let finite = |words: &[u32]| match words.iter().all(|&word| f32::from_bits(word).is_finite()) {
            true => Ok(()),
            false => Err(format!("block {name} of the frozen table holds a number that is not finite")),
        };
        let wrong = self.fill(name, shape, numbers).and_then(finite).err();
        self.wrong = self.wrong.take().or(wrong);
    }
    fn whole_part(&mut self, name: &'static str, shape: &[usize], numbers: &mut impl Words) {
        let wrong = self.fill(name, shape, numbers).err();
        self.wrong = self.wrong.take().or(wrong);
    }
}

fn fill(file: &TableFile, wheel: &mut WheelTable, rover: &mut RoverTable) -> Result<(), String> {
    let mut fill = Fill { file, wrong: None };
    wheel.visit_parts(&mut fill);
    rover.visit_parts(&mut fill);
    fill.wrong.map_or(Ok(()), Err)
}

fn prove(wheel: &WheelTable, rover: &RoverTable) -> Result<(), String> {
    for (name, sound) in [("wheel", wheel.network.cannot_overflow()), ("rover", rover.network.cannot_overflow())] {
        if !sound {
            return Err(format!("block {name}.network of the frozen table has sums that can overflow 32 bits"));
        }
    }
    for (name, reproduced) in [("wheel", wheel.golden_reproduced()), ("rover", rover.golden_reproduced())] {
        if reproduced != GOLDEN_PAIRS {
            let missed = GOLDEN_PAIRS - reproduced;
            return Err(format!("the {name} network does not reproduce {missed} of its {GOLDEN_PAIRS} golden pairs"));
        }
    }
    Ok(())
}

/// The derived `Debug` of the tables is Rust source, and Rust prints an `f32` so that it reads back to the same bits.
fn write(
    path: &Path,
    file_crc: Option<u32>,
    wheel: &WheelTable<FLOWN_PAIRS>,
    rover: &RoverTable<FLOWN_PAIRS>,
) -> Result<(), String> {
    let source = format!(
        "/// CRC-32 of the file of the trained table that was frozen in, if one was.\n\
         pub const FILE_CRC: Option<u32> = {file_crc:?};\n\
         /// Checksum of [`WHEEL`].\npub const WHEEL_CRC: u32 = {:#010x};\n\
         /// Checksum of [`ROVER`].\npub const ROVER_CRC: u32 = {:#010x};\n\
         /// The per-wheel network.\npub static WHEEL: WheelTable<FLOWN_PAIRS> = {wheel:?};\n\
         /// The rover network.\npub static ROVER: RoverTable<FLOWN_PAIRS> = {rover:?};\n",
        checksum(wheel),
        checksum(rover)
    );
    fs::write(path, source).map_err(|error| format!("{}: {error}", path.display()))
}
