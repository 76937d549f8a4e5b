//! The table that `kapvik train` writes: what its seed and what is declared make of it, to the byte.

mod kapvik;
mod refused;

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use assert_cmd::assert::OutputAssertExt;
use kapvik::kapvik;
use refused::refused;

/// The table of a seed.
fn trained(seed: &str, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("a.table");
    kapvik().args(["train", "--quick", "--seed", seed, "-o"]).arg(&table).args(arguments).assert().success();
    std::fs::read_to_string(&table).unwrap()
}

/// Of seed 5, with nothing declared.
static PLAIN: LazyLock<String> = LazyLock::new(|| trained("5", &[]));

fn write(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("declared.toml");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn the_same_seed_gives_the_same_bytes() {
    assert!(*PLAIN == trained("5", &[]), "two runs differ");
    assert!(*PLAIN != trained("6", &[]), "another seed gives the same table");
}

#[test]
fn nothing_declared_gives_the_bytes_of_plain_training_and_an_effect_others() {
    let folder = tempfile::tempdir().unwrap();
    let declaring = |text: &str| trained("5", &["--declared", write(folder.path(), text).to_str().unwrap()]);
    assert!(PLAIN.contains("note effects: none: equations 1-11\n"));
    assert!(*PLAIN == declaring("[declared]\neffects = []\n"));
    let other = declaring("name = \"x\"\n[declared]\neffects = [\"rate\"]\n[soil]\nn = 1.1\n");
    assert!(other.contains("note effects: rate: stiffness -0.6 ... 0.6 uniform\n"), "{}", &other[..900]);
    assert!(other != *PLAIN);
}

#[test]
fn a_file_that_declares_nothing_is_an_error_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for (text, expected) in [
        ("[soil]\nn = 1.1\n", "[declared]"),
        ("[declared]\neffects = [\"slip-sinking\"]\n", "slip-sinkage"),
        ("[declared]\neffects = [\"rate\"]\n[declared.rate]\nstiffness = 9.0\n", "declared.toml:4:"),
    ] {
        write(folder.path(), text);
        let mut command = kapvik();
        command.current_dir(folder.path()).args(["train", "--quick", "-o", "a.table", "--declared", "declared.toml"]);
        refused(&mut command, &[expected]);
    }
}
