//! The published crate: packed, unpacked away from the workspace, and built.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::Command;

use taceva_template::{Kind, Sources, c_project, headers, project};

/// Program that writes every file of the crate, with its path and its length.
const PRINTER: &str = r#"
use taceva_template::{Kind, Sources, c_project, headers, project};

fn main() {
    let name = "my-device".parse().expect("a name");
    let files = project(Kind::Robot, &name, Sources::Vendored).into_iter();
    for file in files.chain(headers()).chain(c_project(Kind::Robot, &name)) {
        print!("{} {}\n{}", file.path, file.text.len(), file.text);
    }
}
"#;

const PRINTER_MANIFEST: &str = r#"
[package]
name = "printer"
edition = "2024"

[dependencies]
taceva-template = { path = "../crate" }

[workspace]
"#;

fn run(command: &mut Command) -> String {
    let done = command.output().expect("cargo and tar are there");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{command:?}: {said}");
    String::from_utf8(done.stdout).expect("text")
}

#[test]
fn the_published_crate_builds_alone_and_embeds_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    run(Command::new(env!("CARGO"))
        .args(["package", "--no-verify", "--allow-dirty", "--offline"])
        // The lockfile would name dependencies of the tests, which the registry lacks.
        .arg("--exclude-lockfile")
        .arg("--target-dir")
        .arg(folder.path().join("packed"))
        .current_dir(here));
    let package = concat!("taceva-template-", env!("CARGO_PKG_VERSION"));
    run(Command::new("tar")
        .arg("-xzf")
        .arg(
            folder
                .path()
                .join(format!("packed/package/{package}.crate")),
        )
        .arg("-C")
        .arg(folder.path()));
    fs::rename(folder.path().join(package), folder.path().join("crate")).expect("unpacked");

    let printer = folder.path().join("printer");
    fs::create_dir_all(printer.join("src")).expect("room");
    fs::write(printer.join("src/main.rs"), PRINTER).expect("room");
    fs::write(printer.join("Cargo.toml"), PRINTER_MANIFEST).expect("room");
    // Uses the versions that are available without a network.
    fs::copy(here.join("../../Cargo.lock"), printer.join("Cargo.lock")).expect("room");
    let printed = run(Command::new(env!("CARGO"))
        .args(["run", "--offline", "--quiet", "--target-dir"])
        .arg(folder.path().join("target"))
        .current_dir(&printer));

    let name = "my-device".parse().expect("a name");
    let files = project(Kind::Robot, &name, Sources::Vendored).into_iter();
    let expected: String = files
        .chain(headers())
        .chain(c_project(Kind::Robot, &name))
        .map(|file| format!("{} {}\n{}", file.path, file.text.len(), file.text))
        .collect();
    assert!(expected.len() > 300_000, "{}", expected.len());
    let differs = |(printed, expected): &(&str, &str)| printed != expected;
    let difference = printed.lines().zip(expected.lines()).find(differs);
    assert_eq!(difference, None, "embedded when packed, and here");
    assert_eq!(printed.len(), expected.len());
}
