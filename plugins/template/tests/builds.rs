//! A new project builds without a network, and its own tests pass.

use std::fs;
use std::path::Path;
use std::process::Command;

use taceva_template::{Kind, Name, Sources, project};

/// Writes a project of each kind, so that the crates they share are built once.
fn write(folder: &Path, kind: Kind) -> Name {
    let name: Name = format!("my-{kind}").parse().expect("a name");
    for file in project(kind, &name, Sources::Vendored) {
        let path = folder.join(name.as_str()).join(&file.path);
        fs::create_dir_all(path.parent().expect("below the folder")).expect("room");
        fs::write(path, file.text).expect("room");
    }
    name
}

#[test]
fn a_new_project_of_every_kind_builds_offline_without_a_warning_and_passes_its_tests() {
    let folder = tempfile::tempdir().expect("a folder");
    for kind in Kind::ALL {
        let name = write(folder.path(), kind);
        let tested = Command::new(env!("CARGO"))
            .args(["test", "--offline", "--quiet"])
            .current_dir(folder.path().join(name.as_str()))
            .env("CARGO_TARGET_DIR", folder.path().join("target"))
            .env("RUSTFLAGS", "-D warnings")
            .env("CARGO_HOME", folder.path().join("home"))
            .output()
            .expect("cargo runs, it runs this test");
        let said = String::from_utf8_lossy(&tested.stderr);
        assert!(tested.status.success(), "{kind}: {said}");
    }
}
