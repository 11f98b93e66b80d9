//! Devices of each kind, built with the C++ helpers and every warning as an error, pass all conformance suites.

use std::path::PathBuf;
use std::sync::Arc;

use taceva_core::{Deadline, Fault, Millimetre, Pose, Rig, Robot, Speed};
use taceva_host::{Children, PluginConfig, PluginHost, Plugins, SearchPath};
use tempfile::TempDir;

use crate::fixture::cpp;

/// Builds the plugin `tests/cpp/NAME.cpp` in a folder; `None` without a C++ compiler.
pub(crate) fn built(name: &str) -> Option<TempDir> {
    cpp(name, &children())
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
