//! The main job in QEMU and on the host: the same bits.

use kapvik_host::data::campaign::Campaign;
use kapvik_host::flight_computer::Computer;
use kapvik_host::report::Findings;

#[test]
fn qemu_and_host_give_the_same_answers() {
    let gather = |on| {
        let campaign = Campaign::carried().expect("the project's own figures");
        Findings::gather(campaign, false, on).expect("answers").flight
    };
    let (qemu, host) = (gather(Computer::Qemu), gather(Computer::Host));
    assert_eq!(qemu.fingerprint, host.fingerprint);
    assert_eq!(qemu.boot, host.boot);
    assert!(qemu.memory.is_some() && qemu.health.stack_high_water_bytes.is_some());
    assert!(!qemu.log.is_empty(), "the image logs");
    assert_eq!(qemu.health.link.refused(), 0);
}
