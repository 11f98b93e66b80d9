//! Programs of the workspace as users start them, built once per test program.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, OnceLock};

use cargo_metadata::Message;

use crate::workspace::root;

/// Builds the command line program and returns its path.
///
/// # Panics
/// If the build fails, which ends the test.
pub fn taceva() -> PathBuf {
    built(&["--bin", "taceva"], "taceva")
}

/// Builds the example `name` of any crate and returns its path.
///
/// # Panics
/// If the build fails, which ends the test.
pub fn example(name: &str) -> PathBuf {
    built(&["--example", name], name)
}

/// Builds the shared library of the crate `package` and returns its path.
///
/// # Panics
/// If the build fails, which ends the test.
pub fn library(package: &str) -> PathBuf {
    built(&["--lib"], &package.replace('-', "_"))
}

fn built(what: &[&str], name: &str) -> PathBuf {
    static BUILT: OnceLock<Mutex<BTreeMap<String, PathBuf>>> = OnceLock::new();
    let built = BUILT.get_or_init(Mutex::default);
    // A build that failed in another test fails again here, with its own message.
    let mut built = built
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    built
        .entry(name.to_owned())
        .or_insert_with(|| build(what, name))
        .clone()
}

/// Builds `what` with the features of the workspace tests, so that nothing is compiled twice.
fn build(what: &[&str], name: &str) -> PathBuf {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["build", "--message-format=json", "--manifest-path"])
        .arg(root().join("Cargo.toml"))
        // Cargo considers the dependencies of tests only together with an example.
        .args(["--workspace", "--example", "toy_writer"])
        .args(what)
        .args(as_this_test())
        .stderr(Stdio::piped())
        .output()
        .expect("cargo runs, it runs this test");
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo build {what:?}: {complaint}");
    Message::parse_stream(output.stdout.as_slice())
        .filter_map(Result::ok)
        .filter_map(|message| match message {
            Message::CompilerArtifact(artifact) if artifact.target.name == name => {
                artifact.executable.or_else(|| {
                    let is_library = artifact.target.is_cdylib();
                    let mut files = artifact.filenames.into_iter();
                    is_library.then(|| {
                        files.find(|file| file.extension() == Some(std::env::consts::DLL_EXTENSION))
                    })?
                })
            }
            _ => None,
        })
        .last()
        .expect("cargo names the program it built")
        .into_std_path_buf()
}

/// Arguments that select the profile folder of this test, so that nothing is built twice.
fn as_this_test() -> Vec<std::ffi::OsString> {
    let test = std::env::current_exe().expect("a test knows where it is");
    // target/debug/deps/test-0123
    let profile = test.parent().and_then(Path::parent);
    let Some((profile, target)) = profile.and_then(|profile| Some((profile, profile.parent()?)))
    else {
        return Vec::new();
    };
    let mut arguments = vec!["--target-dir".into(), target.into()];
    if profile.ends_with("release") {
        arguments.push("--release".into());
    }
    arguments
}
