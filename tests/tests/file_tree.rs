//! The root of the workspace lists its main crates, and things are found by the names of their files.

use std::path::Path;
use std::process::Command;

use taceva_tests::root;

/// Main crates, for which the root is a card.
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

/// Things that a reader looks for: each with its word, and the file whose name contains this word.
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

/// Paths of all files of the checkout, from its root.
fn files() -> Vec<String> {
    // The checkout may belong to another user, as in a container.
    let listed = Command::new("git")
        .args(["-c", "safe.directory=*", "ls-files"])
        .current_dir(root())
        .output()
        .expect("git lists the files of the checkout");
    let said = String::from_utf8_lossy(&listed.stderr);
    assert!(
        listed.status.success(),
        "`git ls-files` in {}: {said}",
        root().display()
    );
    let text = String::from_utf8(listed.stdout).expect("paths are UTF-8");
    text.lines().map(str::to_owned).collect()
}

#[test]
fn the_root_lists_the_card_and_no_more() {
    let files = files();
    let mut found: Vec<&str> = files
        .iter()
        .filter_map(|file| file.split('/').next())
        .collect();
    found.sort_unstable();
    found.dedup();
    let mut expected: Vec<&str> = [&CARD[..], &FOLDERS, &FILES].concat();
    expected.sort_unstable();
    assert_eq!(found, expected);
}

#[test]
fn twelve_things_are_found_by_file_name() {
    let files = files();
    for (thing, word, path) in THINGS {
        let name = Path::new(path).file_name().expect("a file");
        assert!(
            name.to_string_lossy().contains(word),
            "{thing}: the name of {path} lacks `{word}`"
        );
        assert!(
            files.iter().any(|file| file == path),
            "{thing}: {path} is no file of the checkout"
        );
    }
}
