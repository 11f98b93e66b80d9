//! The guide to plugins, followed literally: every block of code in order, in an empty folder.

#![cfg(target_os = "linux")]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use taceva_needs::{Need, skip};

const GUIDE: &str = include_str!("../../../plugins/README.md");

/// A fenced block: its info string and its lines.
struct Block<'a> {
    info: &'a str,
    text: String,
}

fn blocks(section: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut lines = section.lines();
    while let Some(line) = lines.next() {
        if let Some(info) = line.strip_prefix("```") {
            let inside = lines.by_ref().take_while(|line| *line != "```");
            let text = inside.map(|line| format!("{line}\n")).collect();
            blocks.push(Block { info, text });
        }
    }
    blocks
}

/// The part of the guide under a heading.
fn section(heading: &str) -> &'static str {
    let (_, rest) = GUIDE.split_once(heading).expect(heading);
    rest.split_once("\n## ")
        .map_or(rest, |(section, _)| section)
}

/// Executes each block; a `cd` lasts for the following blocks.
fn follow(heading: &str, folder: &Path) -> PathBuf {
    let mut here = folder.to_owned();
    let program = Path::new(env!("CARGO_BIN_EXE_taceva"));
    let own = program.parent().expect("a folder").display();
    let path = format!("{own}:{}", env::var("PATH").unwrap_or_default());
    for block in blocks(section(heading)) {
        match block.info.split_once(' ') {
            Some((_, file)) => fs::write(here.join(file), &block.text).expect(file),
            None => {
                assert_eq!(block.info, "sh", "a block is typed, or names its file");
                let script = format!(
                    "set -eu -o pipefail\n{}\npwd > {:?}",
                    block.text,
                    folder.join("pwd")
                );
                let done = Command::new("bash")
                    .args(["-c", &script])
                    .current_dir(&here)
                    .env("PATH", &path)
                    .env("HOME", folder)
                    .env_remove("CARGO_TARGET_DIR")
                    .env("RUSTUP_HOME", rustup())
                    .env("CARGO_HOME", folder.join("cargo"))
                    .output()
                    .expect("bash");
                let said = [done.stdout, done.stderr].concat();
                let said = String::from_utf8_lossy(&said);
                assert!(done.status.success(), "{}\n{said}", block.text);
                let pwd = fs::read_to_string(folder.join("pwd")).expect("it was written");
                here = PathBuf::from(pwd.trim());
            }
        }
    }
    here
}

/// Folder of rustup of the user who runs the tests, for commands with another home folder.
fn rustup() -> PathBuf {
    let home = || PathBuf::from(env::var_os("HOME").unwrap_or_default()).join(".rustup");
    env::var_os("RUSTUP_HOME").map_or_else(home, PathBuf::from)
}

/// True if `taceva plugin list` lists the plugin `id` of `folder`.
fn is_listed(folder: &Path, id: &str) -> bool {
    let listed = Command::new(env!("CARGO_BIN_EXE_taceva"))
        .args(["plugin", "list", "--plugin-dir"])
        .arg(folder)
        .output()
        .expect("the program runs");
    String::from_utf8_lossy(&listed.stdout).contains(id)
}

#[test]
fn a_plugin_in_rust_is_made_as_the_guide_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let project = follow("## In Rust, in fifteen minutes\n", folder.path());
    assert!(is_listed(&project, "org.example.my-scale"));
}

/// True if the compiler that the test `need`s is installed.
fn has(compiler: &str, need: Need) -> bool {
    let found = Command::new(compiler).arg("--version").output();
    if let Err(error) = &found {
        skip(need, format!("`{compiler}`: {error}"));
    }
    found.is_ok()
}

#[test]
fn a_plugin_in_c_is_made_as_the_guide_says() {
    if !has("cc", Need::CCompiler) {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let project = follow("## In C, in fifteen minutes\n", folder.path());
    assert!(is_listed(&project, "org.example.my-eye"));
}

#[test]
fn a_plugin_in_cpp_is_made_as_the_guide_says() {
    if !has("c++", Need::CppCompiler) {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let project = follow("## In C++\n", folder.path());
    assert!(is_listed(&project, "org.example.my-wrist"));
    let first = project.with_file_name("my-skin");
    assert!(is_listed(&first, "org.example.my-skin"));
}

#[test]
fn a_folder_that_is_there_is_left_alone_and_a_name_that_cannot_be_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let new = |name: &str| {
        let done = Command::new(env!("CARGO_BIN_EXE_taceva"))
            .args(["plugin", "new", "sensor", name])
            .current_dir(folder.path())
            .output()
            .expect("the program runs");
        (
            done.status.success(),
            String::from_utf8_lossy(&done.stderr).into_owned(),
        )
    };
    fs::create_dir(folder.path().join("mine")).expect("room");
    let (is_done, said) = new("mine");
    assert!(!is_done && said.contains("mine exists already"), "{said}");
    for name in ["../mine", "Mine", "move"] {
        let (is_done, said) = new(name);
        assert!(
            !is_done && said.contains("is not a valid name for a plugin"),
            "{said}"
        );
    }
    assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 1);
}
