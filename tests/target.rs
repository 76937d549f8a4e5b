//! What the arithmetic costs on the target, and that it gives the bits of the host.

use std::sync::OnceLock;
use std::time::Duration;

use kapvik_firmware::fingerprint::FINGERPRINTS;
use kapvik_host::qemu::TargetBench;
use kapvik_tests::{budgets, toolchain};

fn bench() -> &'static TargetBench {
    static BENCH: OnceLock<TargetBench> = OnceLock::new();
    BENCH.get_or_init(|| {
        TargetBench::run(toolchain(), Duration::from_secs(600)).unwrap_or_else(|error| panic!("{error}"))
    })
}

#[test]
fn host_and_target_give_the_same_bits() {
    let target = &bench().fingerprints;
    assert_eq!(target.len(), FINGERPRINTS.len());
    for (expected, (name, checksum)) in FINGERPRINTS.iter().zip(target) {
        assert_eq!(name, expected.name);
        assert_eq!(*checksum, (expected.compute)(), "{name} gives other bits on the target");
    }
}

#[test]
fn functions_cost_no_more_than_their_budget() {
    let mut too_dear = Vec::new();
    for (name, budget) in budgets().instructions {
        let kernel = bench().kernels.iter().find(|kernel| kernel.name == name);
        let cost = kernel.unwrap_or_else(|| panic!("{name} has a budget, but is not measured")).instructions;
        println!("{name}: {cost} of {budget} instructions");
        if cost > budget {
            too_dear.push(format!("{name}: {cost} instructions, budget {budget}"));
        }
    }
    assert!(too_dear.is_empty(), "{too_dear:?}");
}
