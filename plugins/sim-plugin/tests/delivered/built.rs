//! Plugins built for these tests, each in a separate folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use cargo_metadata::Message;
use taceva_host::{Children, PluginConfig, PluginHost, Plugins, SearchPath};
use taceva_needs::{Need, skip};

/// Process in which plugin code runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Delivery {
    InProcess,
    Child,
}

/// Folder of the workspace.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Library of this crate, built with the compiler flags `flags` and the development profile.
fn library(flags: &[&str]) -> PathBuf {
    let test = std::env::current_exe().expect("a test knows where it is");
    // Path of this test: target/debug/deps/test-0123.
    let target = test.ancestors().nth(3).expect("a target folder");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.current_dir(root()).args([
        "build",
        "--package",
        "taceva-sim-plugin",
        "--message-format=json",
        "--target-dir",
    ]);
    if flags.is_empty() {
        // The target folder of this test already has nearly all build products.
        cargo.arg(target);
    } else {
        cargo.arg(target.join("flagged"));
        cargo.env("CARGO_ENCODED_RUSTFLAGS", flags.join("\x1f"));
    }
    let built = cargo.output().expect("cargo runs, it runs this test");
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

/// Installs the simulated bench, built with `flags`, in `folder`.
pub(crate) fn lay_bench(folder: &Path, flags: &[&str]) {
    fs::create_dir_all(folder).expect("a folder");
    fs::copy(library(flags), folder.join("libtaceva_sim_plugin.so")).expect("room");
    let manifest = root().join("plugins/sim-plugin/plugin.toml");
    fs::copy(manifest, folder.join("plugin.toml")).expect("room");
}

/// Builds the C example as the plugin `org.example.<word>`. Prints the reason and returns `false` if a tool is missing.
pub(crate) fn lay_c(folder: &Path, word: &str, compiler: &str, level: &str) -> bool {
    for tool in [compiler, "make"] {
        if let Err(error) = Command::new(tool).arg("--version").output() {
            let need = match tool {
                "clang" => Need::Clang,
                _ => Need::CCompiler,
            };
            skip(need, format!("`{tool}`: {error}"));
            return false;
        }
    }
    let example = root().join("plugins/c-example");
    fs::create_dir_all(folder.join("src")).expect("a folder");
    let sources = [
        "plugin.c",
        "sensor.c",
        "robot.c",
        "force.c",
        "lighting.c",
        "changer.c",
        "estimator.c",
        "text.h",
        "waiting.h",
    ]
    .map(|name| format!("src/{name}"));
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
        .arg(format!("CC={compiler}"))
        .arg(format!("INCLUDE={}", include.display()))
        .arg(format!("CFLAGS={level} -Wall -Wextra -Wpedantic -Werror"))
        .output()
        .expect("it was asked for its version");
    let said = String::from_utf8_lossy(&made.stderr);
    assert!(made.status.success(), "{said}");
    true
}

/// Host of the plugins below `folder`. Their code runs in the process that `delivery` names.
pub(crate) fn host(folder: &Path, delivery: Delivery) -> Arc<PluginHost> {
    let plugins = Plugins::search(SearchPath::empty().given([folder.to_owned()]), &[]);
    let rejections = &plugins.rejections;
    assert!(rejections.is_empty(), "{rejections:?}");
    let mut config = PluginConfig::default();
    if delivery == Delivery::InProcess {
        config.trusted_now = plugins.iter().map(|plugin| plugin.id().clone()).collect();
    }
    let log = Arc::new(|_: &_, _, _: &_, _: &_| ());
    PluginHost::with_children(plugins, config, log, Children::default())
}
