//! Crates that a build of one package compiles.

use std::collections::BTreeSet;
use std::process::Command;

use crate::root;

/// Crates of a build of `package` on this machine, itself among them, as name and version. Build scripts do not count.
///
/// # Panics
/// If cargo fails, which ends the program.
pub fn compiled_crates(package: &str) -> BTreeSet<String> {
    let mut tree = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    tree.current_dir(root())
        .args(["tree", "--offline", "--package"]);
    tree.args([package, "--edges", "normal", "--prefix", "none"]);
    let output = tree.output().expect("cargo starts");
    assert!(output.status.success(), "{tree:?}");
    let text = String::from_utf8_lossy(&output.stdout);
    let crates = text.lines().map(|line| {
        let words: Vec<&str> = line.split(' ').take(2).collect();
        words.join(" ")
    });
    crates.filter(|name| !name.is_empty()).collect()
}
