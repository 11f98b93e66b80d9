//! A device of each kind by the helpers for C++, built with every warning an error, and held to every promise.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use taceva_core::{Deadline, Fault, Millimetre, Pose, Rig, Robot, Speed};
use taceva_host::{
    CheckOutcome, CheckRequest, Children, Image, LibraryFile, Offer, PluginConfig, PluginHost,
    Plugins, SearchPath,
};
use taceva_needs::{Need, skip};
use tempfile::TempDir;

/// The plugin of `tests/cpp/NAME.cpp` in a folder, with the manifest that its library gives; `None` where there is no compiler of C++.
pub(crate) fn built(name: &str) -> Option<TempDir> {
    let folder = tempfile::tempdir().expect("a folder");
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var("CXX").unwrap_or_else(|_| "c++".to_owned());
    let built = Command::new(&compiler)
        .args([
            "-std=c++17",
            "-O1",
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Werror",
        ])
        .args(["-shared", "-fPIC", "-fvisibility=hidden", "-pthread", "-I"])
        .arg(here.join("../abi/include"))
        .arg(here.join(format!("tests/cpp/{name}.cpp")))
        .arg("-o")
        .arg(folder.path().join(format!("lib{name}.so")))
        .output();
    match built {
        Ok(done) => assert!(
            done.status.success(),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        ),
        Err(error) => {
            skip(Need::CppCompiler, format!("`{compiler}`: {error}"));
            return None;
        }
    }
    let library = LibraryFile {
        path: format!("lib{name}.so"),
        sha256: None,
    };
    let image = Image::read(folder.path(), &library).expect("a library");
    let offer = Offer::of(&image, &children()).unwrap_or_else(|error| panic!("{error}"));
    let manifest = offer
        .manifest("", &library, Some("MIT"))
        .expect("a manifest");
    fs::write(folder.path().join("plugin.toml"), manifest).expect("written");
    Some(folder)
}

pub(crate) fn children() -> Children {
    Children {
        program: Some(PathBuf::from(env!("CARGO_BIN_EXE_taceva-host-child"))),
        quarantine: None,
    }
}

fn host(folder: &TempDir) -> Arc<PluginHost> {
    let path = SearchPath::empty().given([folder.path().to_owned()]);
    let log = Arc::new(|_: &_, _, _: &str, _: &str| {});
    let plugins = Plugins::search(path, &[]);
    PluginHost::with_children(plugins, PluginConfig::default(), log, children())
}

#[test]
fn a_device_of_each_kind_in_cpp_keeps_every_promise() {
    let Some(folder) = built("kinds") else {
        return;
    };
    let host = host(&folder);
    let plugin = host.plugins().get("org.example.kinds").expect("found");
    assert_eq!(plugin.manifest.drivers().count(), 5);
    let (mut made, mut failed) = (0, Vec::new());
    host.check(plugin, &CheckRequest::default(), &mut |result| {
        made += 1;
        // How long a wait takes that is ended within 50 ms depends on what else the machine does.
        let is_timed = result.check.ends_with("within-50-ms");
        if let CheckOutcome::Failed(why) = result.outcome
            && !is_timed
        {
            failed.push(format!("{} of {:?}: {why}", result.check, result.subject));
        }
    })
    .expect("it can be checked");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(made > 90, "{made} checks");
}

#[test]
fn what_a_robot_in_cpp_throws_as_a_fault_is_one() {
    const SECOND: Deadline = Deadline::after(std::time::Duration::from_secs(1));
    let Some(folder) = built("kinds") else {
        return;
    };
    let arm = host(&folder).drivers::<dyn Robot>().swap_remove(0);
    let mut arm = arm
        .open(&taceva_core::Args::default(), &mut Rig::new())
        .expect("opens");
    let fast = Speed::try_new(100.0).expect("above 0");
    let mut behind_the_wall = Pose::default();
    behind_the_wall.position.x = Millimetre(15.0);
    let error = arm.move_to(behind_the_wall, fast, SECOND);
    let error = error.expect_err("there is a wall");
    assert_eq!(error.fault(), Some(Fault::Collision), "{error}");
    assert!(
        error.to_string().ends_with("collision: the wall"),
        "{error}"
    );
}
