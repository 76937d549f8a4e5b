//! Tells the linker where memory and vectors of a flight image go.

use std::path::Path;

fn main() {
    link_search();
}

/// Lays the image out as the workspace's `memory.x` says. Here and not in the configuration of cargo, where the
/// environment variable `RUSTFLAGS` would silently replace it.
fn link_search() {
    let manifest = std::env::var("CARGO_MANIFEST_DIR").expect("cargo names the package's folder");
    let workspace = Path::new(&manifest).parent().expect("the package is inside the workspace");
    println!("cargo:rerun-if-changed={}", workspace.join("memory.x").display());
    println!("cargo:rustc-link-search={}", workspace.display());
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    for script in ["link.x", "defmt.x"] {
        println!("cargo:rustc-link-arg-bins=-T{script}");
    }
}
