//! Tests that a study has the same bytes for three kinds of devices: linked in, loaded as a plugin in process, or run in a confined child process.

use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;

use taceva_tests::power_cut::{Tree, read_tree};
use taceva_tests::{library, root, scratch, taceva};

/// Short scene with forces, two units, a second light and a board. The plugin's manifest lacks the picture size.
const SCENE: &str = r#"scene_version = 1
name = "study"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
lighting = { driver = "sim/lighting" }
model = { name = "ridge", set = { size = "8x8" } }
sensor = { driver = "sim/vitactip:reduction=16", units = ["1", "2"] }
protocol = { calibration = { points = 4, indentations = 2 }, spatial = { points = 3 }, gratings = { step_mm = 0.75, presses = 2 }, lighting = { points = 1 }, repeatability = { points = 1, trials = 2, depth_step_mm = 0.5 }, hysteresis = { points = 1, depth_step_mm = 0.5 }, surface = { points = 3 }, idle = { frames = 4 } }
"#;

const PLUGIN: &str = "org.taceva.sim/";

/// Creates a folder that contains the simulated bench as a plugin.
fn plugin() -> tempfile::TempDir {
    let folder = scratch();
    let built = library("taceva-sim-plugin");
    let name = built.file_name().expect("a file");
    std::fs::copy(&built, folder.path().join(name)).expect("room for a library");
    let manifest = root().join("plugins/sim-plugin/plugin.toml");
    std::fs::copy(manifest, folder.path().join("plugin.toml")).expect("room for a manifest");
    folder
}

/// Files and output of a study of `scene`.
fn studied(scene: &str, arguments: &[&Path]) -> (Tree, String) {
    let folder = scratch();
    std::fs::write(folder.path().join("study.toml"), scene).expect("room for a scene");
    let output = Command::new(taceva())
        .current_dir(folder.path())
        .args(["run", "study.toml", "--out", "run", "--no-cache", "--quiet"])
        .args(arguments)
        // No settings, plugins or quarantine of a user.
        .env("HOME", folder.path())
        .env_remove("XDG_CONFIG_HOME")
        .env_remove("XDG_DATA_HOME")
        .env_remove("XDG_STATE_HOME")
        .env_remove("TACEVA_PLUGIN_PATH")
        .stdin(Stdio::null())
        .output()
        .expect("the program was built");
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    let tree = read_tree(&folder.path().join("run")).expect("a folder");
    let printed = String::from_utf8(output.stdout).expect("text");
    (tree, printed)
}

/// The same files with the plugin's driver names replaced by the linked ones, and the number of files changed.
fn renamed(mut tree: Tree) -> (Tree, usize) {
    let mut named = 0;
    for bytes in tree.values_mut().flatten() {
        if let Ok(text) = std::str::from_utf8(bytes)
            && text.contains(PLUGIN)
        {
            named += 1;
            *bytes = Arc::new(text.replace(PLUGIN, "sim/").into_bytes());
        }
    }
    (tree, named)
}

fn first_difference(found: &Tree, expected: &Tree) -> Option<String> {
    let mut paths = expected.keys().chain(found.keys());
    let path = paths.find(|path| expected.get(*path) != found.get(*path))?;
    Some(path.clone())
}

#[test]
fn a_study_has_the_same_bytes_linked_in_in_process_and_in_a_child() {
    let plugin = plugin();
    let of_plugin = SCENE.replace("\"sim/", &format!("\"{PLUGIN}"));
    let folder = [Path::new("--plugin-dir"), plugin.path()];
    let trusted = [
        &folder[..],
        &["--trust".as_ref(), "org.taceva.sim".as_ref()],
    ]
    .concat();

    let (linked, _) = studied(SCENE, &[]);
    let (in_process, printed) = studied(&of_plugin, &trusted);
    let (in_child, printed_in_child) = studied(&of_plugin, &folder);

    assert_eq!(first_difference(&in_child, &in_process), None);
    assert_eq!(printed_in_child, printed);
    let (in_child, named) = renamed(in_child);
    assert!(named > 0, "the scene names the drivers");
    assert_eq!(first_difference(&in_child, &linked), None);
    assert!(linked.len() > 40, "only {} files", linked.len());
}
