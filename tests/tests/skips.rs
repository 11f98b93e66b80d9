//! Every skip of a test appears in the list that `.ci/test` prints: no test may skip unnoticed.

use std::path::{Path, PathBuf};

use taceva_tests::{metadata, read};

/// Rust files in the `tests` folders of the crates, at any depth.
fn tests_of_crates() -> Vec<PathBuf> {
    let packages = metadata().packages;
    let folders = packages.iter().filter_map(|package| {
        let folder = package.manifest_path.parent()?.as_std_path();
        Some(folder.join("tests"))
    });
    let mut left: Vec<PathBuf> = folders.filter(|folder| folder.is_dir()).collect();
    let mut found = Vec::new();
    while let Some(folder) = left.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder of the workspace") {
            let path = entry.expect("readable").path();
            if path.is_dir() && !path.is_symlink() {
                left.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(path);
            }
        }
    }
    found
}

#[test]
fn every_skip_goes_into_the_list() {
    // In two parts, so that this file does not contain the searched text.
    let words = ["\"skipped", ": "].concat();
    let files = tests_of_crates();
    assert!(files.len() > 150, "only {} files were found", files.len());
    let hidden: Vec<&Path> = files
        .iter()
        .filter(|file| {
            let text = std::fs::read_to_string(file).expect("readable");
            text.contains(&words)
        })
        .map(PathBuf::as_path)
        .collect();
    assert!(hidden.is_empty(), "use taceva_needs::skip: {hidden:?}");
}

#[test]
fn what_is_installed_for_tests_are_the_needs_that_can_be() {
    let install = read(".ci/install");
    let list = install
        .lines()
        .find_map(|line| line.strip_prefix("needs=\""));
    let words: Vec<&str> = list
        .and_then(|list| list.strip_suffix('"'))
        .expect("the list of needs")
        .split(' ')
        .collect();
    let known = taceva_needs::Need::ALL.map(taceva_needs::Need::word);
    let expected: Vec<&str> = known
        .into_iter()
        // `gpu` is not installed, `.ci/test` builds examples, and a quiet machine must be declared.
        .filter(|word| !["gpu", "quiet-machine", "example"].contains(word))
        .collect();
    assert_eq!(words, expected);
}
