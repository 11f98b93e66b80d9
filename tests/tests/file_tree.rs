//! Tests that the root of the workspace contains only the listed files and folders, and that features are found by the names of their files.

use std::path::Path;
use std::process::Command;

use taceva_tests::root;

/// Folders of the main crates at the root.
const CARD: [&str; 7] = [
    "plugins",
    "taceva-cli",
    "taceva-core",
    "taceva-drivers",
    "taceva-metrics",
    "taceva-models",
    "tests",
];

/// Other folders of the root.
const FOLDERS: [&str; 9] = [
    ".cargo", ".ci", ".github", "benches", "crates", "docs", "examples", "findings", "python",
];

/// Files of the root.
const FILES: [&str; 15] = [
    ".gitignore",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "SECURITY.md",
    "book.toml",
    "deny.toml",
    "rust-toolchain.toml",
    "rustfmt.toml",
];

/// Features that a reader looks for: name, word to search for, and the file whose name contains this word.
const THINGS: [(&str, &str, &str); 12] = [
    ("halt", "halt", "taceva-core/src/driver/halt.rs"),
    (
        "chunks of HDF5",
        "chunk",
        "crates/formats/arrays/src/hdf5/chunk_index.rs",
    ),
    (
        "manifest of a plugin",
        "manifest",
        "plugins/host/src/manifest.rs",
    ),
    ("skill", "skill", "taceva-metrics/src/catalogue/skill.rs"),
    (
        "zero of a press",
        "zero",
        "crates/studies/protocol/src/run/depth_zero.rs",
    ),
    (
        "pairing of rows",
        "row_pairs",
        "crates/studies/evaluate/src/score/row_pairs.rs",
    ),
    (
        "guard",
        "guard",
        "crates/studies/acquire/src/presses/guardian.rs",
    ),
    ("seal", "seal", "crates/files/src/seal.rs"),
    ("wear", "wear", "crates/studies/stress/src/wear.rs"),
    ("slip", "slip", "crates/studies/protocol/src/phase/slip.rs"),
    ("ranking", "ranking", "crates/results/tasks/src/ranking.rs"),
    (
        "dashboard of UR",
        "dashboard",
        "tests/wire/src/ur/dashboard.rs",
    ),
];

/// Names at the root that git knows. `None` for a source tree without git, as from an archive.
fn names_at_the_root() -> Option<Vec<String>> {
    // The checkout may belong to another user, as in a container.
    let listed = Command::new("git")
        .args(["-c", "safe.directory=*", "ls-files"])
        .current_dir(root())
        .output()
        .ok()?;
    let text = String::from_utf8(listed.stdout).ok()?;
    let names = text.lines().filter_map(|file| file.split('/').next());
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort_unstable();
    names.dedup();
    (listed.status.success() && !names.is_empty()).then_some(names)
}

#[test]
fn the_root_lists_the_card_and_no_more() {
    let mut expected: Vec<&str> = [&CARD[..], &FOLDERS, &FILES].concat();
    expected.sort_unstable();
    for name in &expected {
        assert!(root().join(name).exists(), "{name} is absent");
    }
    if let Some(found) = names_at_the_root() {
        assert_eq!(found, expected);
    }
}

#[test]
fn twelve_things_are_found_by_file_name() {
    for (thing, word, path) in THINGS {
        let name = Path::new(path).file_name().expect("a file");
        assert!(
            name.to_string_lossy().contains(word),
            "{thing}: the name of {path} lacks `{word}`"
        );
        assert!(root().join(path).is_file(), "{thing}: {path} is absent");
    }
}
