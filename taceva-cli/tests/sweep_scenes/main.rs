//! Scenes in a sweep: acquired once, before any task, on the simulated bench alone.

mod acquired;
mod refused;
mod stopped;
#[path = "../support/mod.rs"]
mod support;

use std::fs;
use std::sync::LazyLock;

use support::Bench;
use support::kept::Kept;

/// One sensor, pressed at a few places.
const TINY: &str = r#"scene_version = 1
name = "tiny"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
sensor = { driver = "sim/vitactip:reduction=16" }
model = { name = "ridge", set = { size = "8x8" } }
metrics = { want = ["accuracy"] }
protocol = { calibration = { points = 12, indentations = 2 } }
"#;
/// Its sweep: two tasks.
const SWEEP: &str = r#"sweep_version = 1
scenes = ["tiny.toml"]
models = ["ridge", "baseline"]
splits = ["by-point 50/10/40"]
metrics = ["accuracy"]
[vary]
size = ["8x8"]
"#;
/// Where it is recorded.
const RECORDING: &str = "which.sweep/scenes/tiny/recordings/1-tiny";

/// The folder of the sweep, scored.
static SCORED: LazyLock<Kept> = LazyLock::new(|| {
    let bench = tiny();
    bench.ok("sweep which.toml -q");
    Kept::of(&bench.path("which.sweep"))
});

/// The scene and its sweep, not begun.
fn tiny() -> Bench {
    let bench = Bench::new();
    bench.write("tiny.toml", TINY);
    bench.write("which.toml", SWEEP);
    bench
}

/// The same, acquired and scored.
fn scored() -> Bench {
    let bench = tiny();
    SCORED.put(&bench.path("which.sweep"));
    bench
}

/// What the sweep in `folder` has ended in.
fn bytes(bench: &Bench, folder: &str) -> Vec<Vec<u8>> {
    support::sweeps::bytes(bench, folder)
}

/// What the sweep ends in, whatever happens to it.
fn reference() -> Vec<Vec<u8>> {
    bytes(&scored(), "which.sweep")
}

/// The claims that are held, or were.
fn claims(bench: &Bench) -> usize {
    let entries = fs::read_dir(bench.path("which.sweep/claims")).expect("claims");
    let names = entries.map(|entry| entry.expect("readable").file_name());
    names
        .filter(|name| !name.to_string_lossy().starts_with('.'))
        .count()
}

/// The header of the recording at `path`, which has the digest of all that was recorded.
fn header(bench: &Bench, path: &str) -> String {
    fs::read_to_string(bench.path(path).join("dataset.toml")).expect("a recording")
}
