//! `kapvik bench filter`

use std::time::Duration;

use comfy_table::Table;

use crate::error::HostError;
use crate::qemu::{Binary, Survival, TargetBench};
use crate::setup;
use crate::terminal_table::{align_right, plain_table};

/// How long the image may take: far longer than it does.
const PATIENCE: Duration = Duration::from_secs(1200);

/// A filter whose error is so many standard deviations of a measurement's noise knows less than one measurement does.
const LOST: f64 = 3.0;

/// The filters, as the image names them, and as people read them.
const FILTERS: [(&str, &str); 5] = [
    ("kapvik", "kapvik"),
    ("kapvik-gate-open", "kapvik, gate open"),
    ("kfilter", "kfilter"),
    ("multicalc", "multicalc"),
    ("minikalman", "minikalman"),
];

/// The faults, likewise.
const FAULTS: [(&str, &str); 8] = [
    ("none", "none"),
    ("nan", "NaN"),
    ("infinity", "infinity"),
    ("outlier_1e6", "outlier 1e6"),
    ("dropped", "20 dropped"),
    ("stiff_6_6", "P/R 1e10, 6/6"),
    ("stiff_12_18", "P/R 1e10, 12/18"),
    ("drift", "1e6 steps of drift"),
];

const COSTS: &str = "\
Instructions of a step (prediction and update) in single precision on the Cortex-M4F, states/measurements.
Sigma points for all: α = 1, β = 2, κ = 0. kapvik: gate at 10.8, and ten times as wide a spread where it rejects
most measurements of a step. The others have no gate. minikalman works in buffers of its own, the others on the stack.
Versions: tests/contenders/Cargo.lock.";

const SURVIVAL: &str = "\
Survival: the error at the end, in standard deviations of a measurement's noise. told: it said that something was wrong.
DIED: so many steps after the fault gave no number or failed. LOST: numbers, but worse than one measurement.";

/// Compares filters on the target, on the same problem in the same run.
pub fn execute() -> Result<(), HostError> {
    let toolchain = setup::prepare(None)?;
    let bench = TargetBench::of(&toolchain, Binary::Contenders, PATIENCE)?;
    println!("\n{COSTS}\n{}", costs(&bench)?);
    println!("\n{SURVIVAL}\n{}", survivals(&bench)?);
    Ok(())
}

fn costs(bench: &TargetBench) -> Result<Table, HostError> {
    let mut table = plain_table();
    table.set_header(["", "6/6", "stack, B", "object, B", "12/18", "stack, B", "object, B"]);
    for (name, title) in FILTERS {
        let mut row = vec![title.to_owned()];
        for size in ["6_6", "12_18"] {
            let wanted = format!("{name}_{size}");
            let kernel = bench.kernels.iter().find(|kernel| kernel.name == wanted).ok_or_else(|| missing(&wanted))?;
            let object = bench.objects.iter().find(|object| object.0 == wanted).ok_or_else(|| missing(&wanted))?;
            row.extend([kernel.instructions.to_string(), kernel.stack_bytes.to_string(), object.1.to_string()]);
        }
        table.add_row(row);
    }
    align_right(&mut table);
    Ok(table)
}

fn survivals(bench: &TargetBench) -> Result<Table, HostError> {
    let mut table = plain_table();
    table.set_header([""].into_iter().chain(FILTERS.map(|(_, title)| title)));
    for (fault, title) in FAULTS {
        let mut row = vec![title.to_owned()];
        for (name, _) in FILTERS {
            let survival = bench.survivals.iter().find(|survival| survival.name == name && survival.fault == fault);
            row.push(verdict(survival.ok_or_else(|| missing(&format!("{name} {fault}")))?));
        }
        table.add_row(row);
    }
    Ok(table)
}

fn verdict(survival: &Survival) -> String {
    let (good, steps) = survival.good;
    let (_, end) = survival.errors;
    let told = if survival.told { ", told" } else { "" };
    if good < steps {
        format!("DIED {}/{steps}{told}", steps - good)
    } else if end > LOST {
        format!("LOST {end:.0}{told}")
    } else {
        format!("{end:.2}{told}")
    }
}

fn missing(what: &str) -> HostError {
    HostError::Failed(format!("the measuring image printed nothing about {what}"))
}
