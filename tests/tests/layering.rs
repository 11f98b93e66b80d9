//! Enforces the table of ARCHITECTURE.md: allowed imports between crates, and allowed dependencies of the light crates.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use cargo_metadata::{DependencyKind, Package};
use taceva_tests::{metadata, read};

/// Crates that each crate may import, from the table "Crates, and who may import whom".
fn allowed() -> BTreeMap<String, BTreeSet<String>> {
    let architecture = read("ARCHITECTURE.md");
    let (_, section) = architecture
        .split_once("## Crates, and who may import whom")
        .expect("the section exists");
    let rows: Vec<Vec<&str>> = section
        .lines()
        .skip_while(|line| !line.starts_with('|'))
        .take_while(|line| line.starts_with('|'))
        .skip(2)
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    let names: Vec<String> = rows
        .iter()
        .map(|row| row[0].trim_matches('`').to_owned())
        .collect();
    rows.iter()
        .zip(&names)
        .map(|(row, name)| {
            let imports: BTreeSet<String> = match row[2] {
                "–" => BTreeSet::new(),
                "all of the above" => names
                    .iter()
                    .filter(|other| *other != name)
                    .cloned()
                    .collect(),
                list => list
                    .split(", ")
                    .map(|short| format!("taceva-{short}"))
                    .collect(),
            };
            (name.clone(), imports)
        })
        .collect()
}

fn table_name(package: &Package) -> String {
    if package.name.as_str() == "taceva-tests" {
        "tests".to_owned()
    } else {
        package.name.to_string()
    }
}

#[test]
fn every_edge_between_our_crates_stands_in_the_table() {
    let allowed = allowed();
    let metadata = metadata();
    let ours: BTreeSet<String> = metadata.packages.iter().map(table_name).collect();
    let listed: BTreeSet<String> = allowed.keys().cloned().collect();
    assert_eq!(
        ours, listed,
        "the table lists exactly the crates of the workspace"
    );

    let mut edges = 0;
    for package in &metadata.packages {
        let name = table_name(package);
        for dependency in &package.dependencies {
            let development = dependency.kind == DependencyKind::Development;
            if !dependency.name.starts_with("taceva-") || development {
                continue;
            }
            edges += 1;
            assert!(
                allowed[&name].contains(&dependency.name),
                "{name} imports {}: not in the table",
                dependency.name
            );
        }
    }
    assert!(
        edges >= 10,
        "only {edges} edges were seen: the reader is broken"
    );
}

#[test]
fn core_abi_and_metrics_have_no_dependency_of_their_own() {
    for package in metadata().packages.iter().filter(|package| {
        ["taceva-core", "taceva-abi", "taceva-metrics"].contains(&package.name.as_str())
    }) {
        let foreign: Vec<&str> = package
            .dependencies
            .iter()
            .filter(|dependency| {
                dependency.kind != DependencyKind::Development && !dependency.optional
            })
            .map(|dependency| dependency.name.as_str())
            .filter(|name| !name.starts_with("taceva-"))
            .collect();
        assert_eq!(foreign, Vec::<&str>::new(), "{}", package.name);
    }
}

#[test]
fn every_crate_states_the_oldest_compiler_it_promises() {
    for package in metadata().packages {
        let expected = match package.name.as_str() {
            "taceva-core" | "taceva-abi" | "taceva-plugin" | "taceva-needs" => "1.85.0",
            _ => "1.89.0",
        };
        let stated = package.rust_version.as_ref().map(ToString::to_string);
        assert_eq!(stated.as_deref(), Some(expected), "{}", package.name);
    }
}

#[test]
fn lints_are_never_switched_off_and_unsafe_code_stands_where_the_architecture_says_alone() {
    for package in metadata().packages {
        let folder = package
            .manifest_path
            .parent()
            .expect("a manifest lies in a folder");
        let manifest =
            std::fs::read_to_string(&package.manifest_path).expect("the manifest is there");
        assert!(
            manifest.contains("[lints]\nworkspace = true"),
            "{} has its own lints",
            package.name
        );
        for source in rust_files(folder.as_std_path()) {
            let text = std::fs::read_to_string(&source).expect("readable");
            let allows = text.lines().any(|line| {
                line.trim_start().starts_with("#[allow(") || line.starts_with("#![allow(")
            });
            // Each of several test programs uses only a part of a shared file, so none can expect all of it.
            let is_shared = source
                .parent()
                .and_then(Path::parent)
                .is_some_and(|above| above.ends_with("tests"));
            assert!(
                !allows || is_shared,
                "{}: use #[expect] with a reason",
                source.display()
            );
            let unsafe_code = text.lines().any(|line| line.contains("expect(unsafe_code"));
            let is_simd = source
                .parent()
                .is_some_and(|folder| folder.ends_with("simd"));
            let may_hold_it = match package.name.as_str() {
                "taceva-abi" | "taceva-conformance" | "taceva-host" | "taceva-plugin" => true,
                "taceva-metrics" | "taceva-network" | "taceva-sim" => is_simd,
                "taceva-drivers" => {
                    source.ends_with("v4l2/kernel/ioctls.rs")
                        || source.ends_with("v4l2/kernel/frame_memory.rs")
                }
                "taceva-video" => source.ends_with("av1/rav1d.rs"),
                "taceva-python" => {
                    source.ends_with("buffer.rs") || source.ends_with("arrow/structs.rs")
                }
                _ => false,
            };
            assert!(
                !unsafe_code || may_hold_it || source.ends_with("layering.rs"),
                "{}: unsafe code stands in files of a folder simd/, at the plugin boundary, in two files each of taceva-drivers and taceva-python, and in one of taceva-video alone",
                source.display()
            );
        }
    }
}

fn rust_files(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder of the workspace") {
        let path = entry.expect("readable").path();
        // The target of a link is checked at its own path.
        if path.is_symlink() || path.ends_with("target") {
            continue;
        }
        if path.is_dir() {
            found.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}
