//! A frozen table that is not what the trainer wrote is noticed: in the file, in the build, in memory.

use std::fs;
use std::path::PathBuf;
use std::process::Output;

use kapvik_firmware::estimator::doubt::{self, DoubtNetwork};
use kapvik_firmware::frozen;
use kapvik_firmware::network::{FLOWN_PAIRS, Words, checksum};
use kapvik_firmware::self_test;
use kapvik_host::process::{command, workspace};
use kapvik_table_file::{Block, TableError, TableFile};
use rayon::prelude::*;

fn shipped() -> (PathBuf, Vec<u8>) {
    let path = workspace().join("firmware/weights/kapvik.table");
    let bytes = fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    (path, bytes)
}

/// One bit of each byte, another one from byte to byte: words are nine bytes apart, so that each of their digits has each of its bits
/// flipped somewhere. All bits of a small table are flipped beside its reader.
#[test]
fn a_flipped_bit_in_any_byte_of_the_file_is_noticed() {
    let (_, bytes) = shipped();
    assert!(TableFile::parse(&bytes).is_ok());
    let unseen: Vec<usize> = (0..bytes.len())
        .into_par_iter()
        .map_init(
            || bytes.clone(),
            |copy, place| {
                let bit = 1 << (place % 8);
                copy[place] ^= bit;
                let refused = TableFile::parse(copy).is_err();
                copy[place] ^= bit;
                (!refused).then_some(place)
            },
        )
        .flatten()
        .collect();
    println!("a bit of each of {} bytes of the file flipped, {} not noticed", bytes.len(), unseen.len());
    assert!(unseen.is_empty(), "{unseen:?}");
}

/// Flips a bit of each number of a table in memory, another one from number to number; returns how many were flipped and how many left the
/// checksum as it was.
fn flip_in_each<T: Words + Clone + Sync>(table: &T) -> (usize, usize) {
    let mut count = 0;
    table.for_each(&mut |_| count += 1);
    let sound = checksum(table);
    let flip = |copy: &mut T, flipped: usize| {
        let mut place = 0;
        copy.for_each_mut(&mut |word| {
            if place == flipped {
                *word ^= 1 << (flipped % 32);
            }
            place += 1;
        });
    };
    let unseen = (0..count).into_par_iter().map_init(
        || table.clone(),
        |copy, place| {
            flip(copy, place);
            let same = checksum(copy) == sound;
            flip(copy, place);
            usize::from(same)
        },
    );
    (count, unseen.sum())
}

/// That no number is left out: of what a CRC covers it notices any single bit.
#[test]
fn a_flipped_bit_in_any_number_in_memory_is_noticed() {
    let flipped = [flip_in_each(&frozen::WHEEL), flip_in_each(&frozen::ROVER), flip_in_each(doubt::frozen())];
    let (numbers, unseen) = flipped.into_iter().fold((0, 0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
    println!("a bit of each of {numbers} numbers in memory flipped, {unseen} not noticed");
    assert_eq!(unseen, 0);
}

#[test]
fn the_self_test_fails_on_a_flipped_bit_and_passes_without() {
    assert!(self_test::run().passed());
    assert!(doubt::is_as_trained(doubt::frozen()) && !doubt::is_as_trained(&DoubtNetwork::ZERO));
    let mut rover = frozen::ROVER.clone();
    rover.network.output.bias[0][0] ^= 1 << 16;
    let report = self_test::examine(&frozen::WHEEL, &rover);
    assert!(!report.tables_intact && !report.passed());
    assert_eq!(usize::from(report.wheel_pairs), FLOWN_PAIRS);
    assert!(usize::from(report.rover_pairs) < FLOWN_PAIRS);
}

/// Builds the library on a table of these bytes.
fn build_with(name: &str, bytes: &[u8]) -> Output {
    let folder = workspace().join("target/tables-that-are-refused");
    fs::create_dir_all(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let table = folder.join(format!("{name}.table"));
    fs::write(&table, bytes).unwrap_or_else(|error| panic!("{}: {error}", table.display()));
    let mut build = command("cargo");
    build.args(["check", "--package", "kapvik-firmware", "--quiet"]).env("CARGO_TARGET_DIR", &folder);
    build.env("KAPVIK_WEIGHTS", &table).output().unwrap_or_else(|error| panic!("cargo: {error}"))
}

fn edited(edit: impl FnOnce(&mut TableFile)) -> Vec<u8> {
    let mut file = TableFile::parse(&shipped().1).unwrap_or_else(|error| panic!("{error}"));
    edit(&mut file);
    file.to_text().into_bytes()
}

fn block<'a>(file: &'a mut TableFile, name: &str) -> &'a mut Block {
    let block = file.blocks.iter_mut().find(|block| block.name == name);
    block.unwrap_or_else(|| panic!("the table has no {name}"))
}

/// The first number of a block, as something to spoil.
fn first_word<'a>(file: &'a mut TableFile, name: &str) -> &'a mut u32 {
    block(file, name).words.first_mut().unwrap_or_else(|| panic!("{name} is empty"))
}

/// The golden pairs see a change of a weight in its fourth digit; one in its last digit may round away in all of them,
/// and is left to the checksum.
#[test]
fn a_table_that_is_wrong_stops_the_build_and_says_why() {
    let (_, sound) = shipped();
    assert!(build_with("sound", &sound).status.success());
    let mut altered = sound.clone();
    altered[sound.len() / 2] ^= 1;
    let other_version = String::from_utf8_lossy(&sound).replace("\nversion 3\n", "\nversion 2\n");
    let body = &other_version[..other_version.rfind("crc32 ").unwrap_or(0)];
    let sealed = format!("{body}crc32 {:08x}\n", kapvik_table_file::checksum(body.as_bytes()));
    assert!(matches!(TableFile::parse(sealed.as_bytes()), Err(TableError::Version { .. })));
    let cases: [(&str, Vec<u8>, &str); 7] = [
        ("truncated", sound[..sound.len() - 100].to_vec(), "truncated"),
        ("altered", altered, "was altered"),
        ("version", sealed.into_bytes(), "is of version 2, this build reads version 3"),
        (
            "shape",
            edited(|file| block(file, "wheel.network").shape[1] += 1),
            "block wheel.network of the frozen table has shape",
        ),
        ("golden", edited(|file| *first_word(file, "rover.network") ^= 1 << 10), "golden pairs"),
        ("overflow", edited(|file| *first_word(file, "rover.network") = 0x7fff_7fff), "can overflow 32 bits"),
        ("not-finite", edited(|file| *first_word(file, "wheel.normalisation") = 0x7fc0_0000), "not finite"),
    ];
    for (name, bytes, reason) in cases {
        let output = build_with(name, &bytes);
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success(), "{name}: the build went through");
        assert!(text.contains(reason), "{name}: expected `{reason}` in\n{text}");
    }
}
