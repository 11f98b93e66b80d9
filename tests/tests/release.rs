//! Tests of the parts of a release. `.ci/release` calls each script, the page about releases names each, and release notes are sections of the
//! changelog.

use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Output};

use taceva_tests::{read, root};

/// Scripts in `.ci` that are not part of a release: the release script itself, checks of every change, and others.
const OTHERS: [&str; 7] = [
    "driver-sizes",
    "install",
    "python",
    "release",
    "run",
    "test",
    "workspace-cargo",
];

/// Names of the scripts that are parts of a release.
fn parts() -> BTreeSet<String> {
    let entries = fs::read_dir(root().join(".ci")).expect("the folder of scripts");
    let names = entries.map(|entry| entry.expect("readable").file_name());
    let names = names.map(|name| name.to_string_lossy().into_owned());
    names
        .filter(|name| !OTHERS.contains(&name.as_str()))
        .collect()
}

/// Names of the scripts in `text`, which has them as `.ci/NAME`.
fn scripts(text: &str) -> BTreeSet<String> {
    let names = text.split(".ci/").skip(1).map(|rest| {
        let end = rest.find(|letter: char| letter != '-' && !letter.is_ascii_alphanumeric());
        rest[..end.unwrap_or(rest.len())].to_owned()
    });
    names.filter(|name| !name.is_empty()).collect()
}

/// A script without its lines of comments.
fn commands(script: &str) -> String {
    let text = read(&format!(".ci/{script}"));
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with('#'));
    lines.collect::<Vec<_>>().join("\n")
}

/// Output of `.ci/notes` with these arguments.
fn notes(arguments: &[&str]) -> Output {
    let mut command = Command::new("bash");
    command.arg(root().join(".ci/notes")).args(arguments);
    command.output().expect("bash starts")
}

#[test]
fn the_release_calls_every_part() {
    let mut called = BTreeSet::new();
    let mut left = vec!["release".to_owned()];
    while let Some(script) = left.pop() {
        if called.insert(script.clone()) {
            left.extend(scripts(&commands(&script)));
        }
    }
    let parts = parts();
    assert!(parts.len() > 8, "{parts:?}");
    let idle: Vec<&String> = parts.difference(&called).collect();
    assert!(idle.is_empty(), "no part of a release calls {idle:?}");
}

#[test]
fn the_page_names_every_part_and_no_script_that_is_not_there() {
    let named = scripts(&read("docs/releasing.md"));
    let parts = parts();
    let missing: Vec<&String> = parts.difference(&named).collect();
    assert!(missing.is_empty(), "docs/releasing.md: {missing:?}");
    for script in &named {
        assert!(root().join(".ci").join(script).is_file(), "{script}");
    }
}

#[test]
fn notes_are_the_section_of_a_version_and_want_its_date_but_in_rehearsals() {
    let changelog = read("CHANGELOG.md");
    let headings = changelog
        .lines()
        .filter_map(|line| line.strip_prefix("## ["));
    let sections: Vec<(&str, &str)> = headings
        .filter_map(|heading| heading.split_once("] - "))
        .collect();
    assert!(sections.len() > 1, "{sections:?}");
    for (version, day) in sections {
        let rehearsal = notes(&[version, "--rehearsal"]);
        assert!(rehearsal.status.success(), "{version}");
        let text = String::from_utf8(rehearsal.stdout).expect("text");
        assert!(text.contains("\n- "), "{version}: no change");
        assert!(!text.contains("\n## "), "{version}: another section");
        assert!(changelog.contains(text.trim()), "{version}");
        let is_dated = day.starts_with(|letter: char| letter.is_ascii_digit());
        assert_eq!(notes(&[version]).status.success(), is_dated, "{version}");
    }
    let absent = notes(&["99.0.0", "--rehearsal"]);
    let error = String::from_utf8(absent.stderr).expect("text");
    assert!(!absent.status.success());
    assert!(error.contains("no section `## [99.0.0] - …`"), "{error}");
}

#[test]
fn archive_wheel_and_page_state_one_oldest_glibc() {
    let archive = read(".ci/archive");
    let mut lines = archive.lines();
    let oldest = lines.find_map(|line| line.strip_prefix("glibc="));
    let oldest = oldest.expect("the oldest glibc");
    let page = format!("glibc {oldest} ");
    assert!(read("docs/releasing.md").contains(&page), "{page}");
    let wheel = format!("manylinux_{}", oldest.replace('.', "_"));
    assert!(read(".ci/wheel").contains(&wheel), "{wheel}");
}

#[test]
fn the_linker_of_the_check_links_and_refuses_source_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let list = folder.path().join("refused");
    let links = |arguments: &[&str]| {
        let mut command = Command::new("bash");
        command.arg(root().join(".ci/linker")).args(arguments);
        command.env("TACEVA_LINKER", "true");
        command.env("TACEVA_REFUSED", &list);
        let output = command.output().expect("bash starts");
        output.status.success()
    };
    assert!(links(&["main.o", "-lm", "-o", "main"]));
    assert!(!list.exists());
    assert!(!links(&["-c", "zlib.c"]));
    assert!(!links(&["-shared", "kernel.S"]));
    assert!(!links(&["-E", "-"]));
    let refused = fs::read_to_string(&list).expect("the list");
    assert_eq!(refused.lines().count(), 3, "{refused}");
}
