//! `--weights`: a table other than the shipped one flies in QEMU.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use kapvik_firmware::network::FLOWN_PAIRS;
use kapvik_host::close_loop::train;
use kapvik_host::flight_computer::FlightComputer;
use kapvik_host::process::{command, output_of};
use kapvik_host::train::emit::{Provenance, table_file};
use kapvik_host::train::fifth_input::Candidate;
use kapvik_host::train::plan::Plan;
use kapvik_host::train::world::World;
use kapvik_tests::{estimates_of_the_recorded_drive, recorded_drive};

/// A table after two glances at the soil: good for nothing but being another.
fn other_table(folder: &Path) -> PathBuf {
    let plan = Plan::glance(5);
    let world = World::seed();
    let trained = train(&world, &plan, true).unwrap_or_else(|error| panic!("{error}"));
    let (wheel, loss) = trained.wheel.expect("it was asked for");
    let provenance = Provenance { plan: &plan, world: &world, fifth: Candidate::SHIPPED, losses: [loss, trained.loss] };
    let path = folder.join("other.table");
    fs::write(&path, table_file(wheel, trained.rover, &provenance).expect("networks that fly").to_text())
        .expect("a folder for tests");
    path
}

fn kapvik() -> Command {
    let mut cargo = command("cargo");
    cargo.args(["run", "--quiet", "--release", "--package", "kapvik-host-tools", "--bin", "kapvik", "--"]);
    cargo
}

/// Names and rows of a file of estimates.
fn columns(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().unwrap_or_default(), lines.collect())
}

#[test]
fn another_table_tells_another_soil_from_the_same_wheels() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let table = other_table(folder);
    let report = folder.join("other.html");
    let run =
        output_of(kapvik().arg("run").arg(recorded_drive()).arg("--weights").arg(&table).arg("--report").arg(&report))
            .expect("kapvik run");
    assert!(
        run.contains("in QEMU")
            && run.contains(&format!(
                "passed: tables intact, golden pairs {FLOWN_PAIRS} and {FLOWN_PAIRS} of {FLOWN_PAIRS}"
            )),
        "{run}"
    );
    assert!(run.contains("other.table, trained with none: equations 1-11"), "{run}");
    assert!(fs::read_to_string(&report).is_ok_and(|page| page.contains("other.table")), "the report names it");

    let estimates = folder.join("other.csv");
    output_of(
        kapvik()
            .args(["replay", "--on", "qemu"])
            .arg(recorded_drive())
            .arg("--weights")
            .arg(&table)
            .arg("-o")
            .arg(&estimates),
    )
    .expect("kapvik replay");
    let other = fs::read_to_string(&estimates).expect("estimates");
    let mut computer = FlightComputer::in_process().expect("the library answers in this process");
    let shipped = String::from_utf8(estimates_of_the_recorded_drive(&mut computer)).expect("text");

    let ((names, other), (same_names, shipped)) = (columns(&other), columns(&shipped));
    assert_eq!(names, same_names);
    assert_eq!(other.len(), shipped.len());
    let soil = ["cohesion_pa", "friction_angle_rad", "shear_modulus_m"];
    let (mut of_soil, mut differ) = (0, 0);
    for (number, (other, shipped)) in other.iter().zip(&shipped).enumerate() {
        for (name, (other, shipped)) in names.iter().zip(other.iter().zip(shipped)) {
            if !soil.iter().any(|parameter| name.starts_with(parameter)) {
                assert_eq!(other, shipped, "row {number}: {name}");
            } else if !shipped.is_empty() && !name.ends_with("_identifiable") {
                of_soil += 1;
                differ += usize::from(other != shipped);
            }
        }
    }
    println!("{differ} of {of_soil} numbers of the soil differ");
    assert!(of_soil > 1000 && differ > of_soil * 9 / 10, "{differ} of {of_soil}");
}
