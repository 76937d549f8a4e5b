//! `kapvik train-doubt` with a drive of each kind: the source is written whole, and the same command writes the same bytes.

mod kapvik;
mod told;

use std::fs;

use kapvik::kapvik;
use told::told;

#[test]
fn the_same_command_writes_the_same_source() {
    let folder = tempfile::tempdir().expect("a folder");
    let sources = ["one.rs", "other.rs"].map(|name| {
        let path = folder.path().join(name);
        let mut command = kapvik();
        let printed = told(command.args(["train-doubt", "--seed", "31", "--drives", "1", "--output"]).arg(&path));
        assert!(["dropout", "bogie's pull", "within 2σ"].iter().all(|words| printed.contains(words)), "{printed}");
        fs::read_to_string(path).expect("the source")
    });
    let [one, other] = sources;
    assert_eq!(one, other);
    assert!(one.contains("pub(super) static NETWORK: DoubtNetwork = DoubtNetwork {"), "{one}");
    assert!(one.lines().last().is_some_and(|line| line.starts_with("pub(super) const CHECKSUM: u32 = 0x")), "{one}");
}
