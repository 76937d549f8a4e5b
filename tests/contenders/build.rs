//! Lays the image out as the flight image: the workspace's `memory.x`, the board's runtime and log.

fn main() {
    println!("cargo::rerun-if-changed=../../memory.x");
    println!("cargo::rustc-link-search={}/../..", env!("CARGO_MANIFEST_DIR"));
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
}
