//! What the arithmetic costs on the target, and that it gives the bits of the host.

use std::sync::OnceLock;
use std::time::Duration;

use kapvik_firmware::fingerprint::FINGERPRINTS;
use kapvik_firmware::identification::trial::{LITERATURE, MAP, ONE_BY_ONE};
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
    let arithmetic = FINGERPRINTS.iter().map(|print| (print.name, (print.compute)()));
    let methods = LITERATURE.iter().chain([&ONE_BY_ONE, &MAP]).map(|method| (method.name, method.fingerprint()));
    let host: Vec<_> = arithmetic.chain(methods).map(|(name, checksum)| (name.to_owned(), checksum)).collect();
    assert_eq!(*target, host, "host on the right");
}

#[test]
fn functions_cost_no_more_than_their_budget() {
    let budgets = budgets().instructions;
    let mut wrong = Vec::new();
    for kernel in &bench().kernels {
        let (name, cost) = (&kernel.name, kernel.instructions);
        match budgets.get(name) {
            None => wrong.push(format!("{name} is measured, but has no budget; it costs {cost} instructions")),
            Some(budget) if cost > *budget => wrong.push(format!("{name}: {cost} instructions, budget {budget}")),
            Some(budget) => println!("{name}: {cost} of {budget} instructions"),
        }
    }
    let measured = |name: &String| bench().kernels.iter().any(|kernel| kernel.name == *name);
    wrong.extend(
        budgets.keys().filter(|name| !measured(name)).map(|name| format!("{name} has a budget, but is not measured")),
    );
    assert!(wrong.is_empty(), "{wrong:#?}");
}
