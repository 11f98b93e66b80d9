//! The minimum Rust version stated by each crate holds for all its dependencies, and every document states the same version.

use std::collections::{BTreeMap, BTreeSet};

use cargo_metadata::semver::Version;
use cargo_metadata::{DependencyKind, Metadata, MetadataCommand, Node, Package, PackageId};
use taceva_tests::{read, root};

/// Cargo's metadata of the workspace with its dependencies, for a build without features.
fn metadata() -> Metadata {
    MetadataCommand::new()
        .manifest_path(root().join("Cargo.toml"))
        .exec()
        .expect("cargo metadata of the workspace that is being tested")
}

/// All packages that are compiled into `package` or needed to build it, on any platform, except for its tests.
fn tree<'a>(package: &Package, metadata: &'a Metadata) -> Vec<&'a Package> {
    let resolve = metadata
        .resolve
        .as_ref()
        .expect("dependencies were asked for");
    let nodes: BTreeMap<&PackageId, &Node> =
        resolve.nodes.iter().map(|node| (&node.id, node)).collect();
    let mut seen = BTreeSet::new();
    let mut left = vec![&package.id];
    while let Some(id) = left.pop() {
        let Some(node) = nodes.get(id).filter(|_| seen.insert(id.clone())) else {
            continue;
        };
        let built = node.deps.iter().filter(|dependency| {
            let kinds = dependency.dep_kinds.iter().map(|kind| kind.kind);
            kinds
                .clone()
                .any(|kind| kind != DependencyKind::Development)
        });
        left.extend(built.map(|dependency| &dependency.pkg));
    }
    let packages = metadata.packages.iter();
    packages
        .filter(|package| seen.contains(&package.id))
        .collect()
}

/// Crates of the workspace, with the Rust version that each states.
fn ours(metadata: &Metadata) -> Vec<(&Package, Version)> {
    let packages = metadata.workspace_packages().into_iter();
    packages
        .map(|package| {
            let stated = package.rust_version.clone();
            (
                package,
                stated.unwrap_or_else(|| panic!("{}: no rust-version", package.name)),
            )
        })
        .collect()
}

#[test]
fn no_dependency_needs_a_newer_compiler_than_the_crate_that_takes_it_states() {
    let metadata = metadata();
    let mut compared = 0;
    for (package, stated) in ours(&metadata) {
        for dependency in tree(package, &metadata) {
            let Some(needed) = &dependency.rust_version else {
                continue;
            };
            compared += 1;
            assert!(
                *needed <= stated,
                "{} states Rust {stated}, its dependency {} {} needs {needed}",
                package.name,
                dependency.name,
                dependency.version
            );
        }
    }
    assert!(compared > 300, "only {compared} dependencies were seen");
}

/// Version after `words` in `text`: `1.89` in `Minimum supported Rust version: 1.89.`
fn version_after<'a>(text: &'a str, words: &str) -> Option<&'a str> {
    let (_, rest) = text.split_once(words)?;
    let end = rest.find(|letter: char| letter != '.' && !letter.is_ascii_digit());
    Some(rest[..end.unwrap_or(rest.len())].trim_end_matches('.'))
}

#[test]
fn every_readme_states_the_version_of_its_manifest() {
    const WORDS: &str = "Minimum supported Rust version: ";
    let metadata = metadata();
    let mut found = 0;
    for (package, stated) in ours(&metadata) {
        let readme = package.manifest_path.with_file_name("README.md");
        let Ok(text) = std::fs::read_to_string(&readme) else {
            continue;
        };
        let Some(version) = version_after(&text, WORDS) else {
            assert!(!text.contains("MSRV"), "{readme}: write `{WORDS}…`");
            continue;
        };
        assert_eq!(
            version,
            format!("{}.{}", stated.major, stated.minor),
            "{readme}"
        );
        found += 1;
    }
    assert!(found >= 13, "only {found} READMEs state a version");

    let text = read("README.md");
    let core = version_after(&text, WORDS);
    let rest = version_after(&text, "for `taceva-core`, ");
    let of = |name: &str| {
        let versions = ours(&metadata).into_iter();
        let mut versions = versions.filter(|(package, _)| package.name.as_str() == name);
        let (_, version) = versions.next().expect("a crate of the workspace");
        format!("{}.{}", version.major, version.minor)
    };
    assert_eq!(core, Some(&*of("taceva-core")));
    assert_eq!(rest, Some(&*of("taceva-cli")));
}

#[test]
fn the_compiler_that_the_project_is_built_with_is_no_older_than_what_it_states() {
    let toolchain = read("rust-toolchain.toml");
    let channel = version_after(&toolchain, "channel = \"").expect("a version");
    let channel: Version = channel.parse().expect("three numbers");
    for (package, stated) in ours(&metadata()) {
        assert!(stated <= channel, "{}: {stated}", package.name);
    }
}
