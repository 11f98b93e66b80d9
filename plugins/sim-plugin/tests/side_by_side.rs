//! Plugins in C and in Rust, by different compilers and flags, in one process at once: each keeps the contract of its kinds.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use cargo_metadata::Message;
use taceva_core::{ForceTransducer, Lighting, Robot, Sensor};
use taceva_drivers::conformance::{self, Report, Trial};
use taceva_host::{PluginConfig, PluginHost, Plugins, SearchPath};
use tempfile::TempDir;

/// The workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The library of this crate as it is delivered, built where this test was built.
fn bench() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows where it is");
    // target/debug/deps/test-0123
    let target = test.ancestors().nth(3).expect("a target folder");
    let built = Command::new(env!("CARGO"))
        .args([
            "build",
            "--package",
            "taceva-sim-plugin",
            "--message-format=json",
            "--target-dir",
        ])
        .arg(target)
        .current_dir(root())
        .output()
        .expect("cargo runs, it runs this test");
    let said = String::from_utf8_lossy(&built.stderr);
    assert!(built.status.success(), "{said}");
    let files = Message::parse_stream(built.stdout.as_slice())
        .filter_map(Result::ok)
        .filter_map(|message| match message {
            Message::CompilerArtifact(artifact) => Some(artifact.filenames),
            _ => None,
        })
        .flatten();
    let library = files.filter(|file| file.extension() == Some("so")).last();
    library
        .expect("cargo names the library")
        .into_std_path_buf()
}

/// Builds the example in C as the plugin `org.example.<word>`; `false`, with the reason printed, where there is no compiler.
#[expect(clippy::print_stderr, reason = "a skipped test must say why")]
fn build_c(folder: &Path, word: &str, flags: &str) -> bool {
    let example = root().join("plugins/c-example");
    fs::create_dir_all(folder.join("src")).expect("a folder");
    let sources =
        ["plugin.c", "sensor.c", "force.c", "waiting.h"].map(|name| format!("src/{name}"));
    for name in sources
        .iter()
        .map(String::as_str)
        .chain(["Makefile", "plugin.toml"])
    {
        let text = fs::read_to_string(example.join(name)).expect("a file of the example");
        let text = text.replace("org.example.bar", &format!("org.example.{word}"));
        fs::write(folder.join(name), text).expect("room");
    }
    let include = root().join("plugins/abi/include");
    let made = Command::new("make")
        .current_dir(folder)
        .arg(format!("INCLUDE={}", include.display()))
        .arg(format!("CFLAGS={flags}"))
        .output();
    match made {
        Ok(made) => {
            let said = String::from_utf8_lossy(&made.stderr);
            assert!(made.status.success(), "{said}");
            true
        }
        Err(error) => {
            eprintln!("skipped: `make`: {error}");
            false
        }
    }
}

/// Lays the simulated bench into `folder`.
fn lay_bench(folder: &Path) {
    fs::create_dir_all(folder).expect("a folder");
    fs::copy(bench(), folder.join("libtaceva_sim_plugin.so")).expect("room");
    let manifest = root().join("plugins/sim-plugin/plugin.toml");
    fs::copy(manifest, folder.join("plugin.toml")).expect("room");
}

#[test]
fn plugins_of_different_languages_and_flags_work_in_one_process() {
    let scratch = TempDir::new().expect("a folder");
    let flags = "-Wall -Wextra -Wpedantic -Werror";
    let words = [("plain", "-O0"), ("whole", "-O3 -flto")];
    let c = words.map(|(word, level)| {
        build_c(
            &scratch.path().join(word),
            word,
            &format!("{level} {flags}"),
        )
    });
    lay_bench(&scratch.path().join("bench"));

    let folders = SearchPath::empty().given([scratch.path().to_owned()]);
    let plugins = Plugins::search(folders, &[]);
    let expected = 1 + c.iter().filter(|is_there| **is_there).count();
    assert_eq!(plugins.len(), expected, "{:?}", plugins.rejections);
    let config = PluginConfig {
        trusted_now: plugins.iter().map(|plugin| plugin.id().clone()).collect(),
        ..PluginConfig::default()
    };
    let host = PluginHost::new(plugins, config, Arc::new(|_, _, _, _| ()));

    let trial = Trial::default();
    let mut reports: Vec<Report> = Vec::new();
    for driver in host.drivers::<dyn Sensor>() {
        reports.push(conformance::sensor(&*driver, &trial));
    }
    for driver in host.drivers::<dyn Robot>() {
        reports.push(conformance::robot(&*driver, &trial));
    }
    for driver in host.drivers::<dyn ForceTransducer>() {
        reports.push(conformance::force(&*driver, &trial));
    }
    for driver in host.drivers::<dyn Lighting>() {
        reports.push(conformance::lighting(&*driver, &trial));
    }
    assert_eq!(reports.len(), 7 + 2 * (expected - 1));
    for report in reports {
        assert!(report.passed(), "{report}");
    }
}
