//! Scenes in a sweep: acquired once, before any task, on the simulated bench alone.

mod acquired;
pub(crate) mod refused;
mod stopped;

use std::fs;
use std::sync::LazyLock;

use crate::support::Bench;
use crate::support::snapshot::Snapshot;
use crate::support::sweeps::{TINY, TINY_SWEEP as SWEEP};

/// Folder of the recording of the scene.
const RECORDING: &str = "which.sweep/scenes/tiny/recordings/1-tiny";

/// Folder of the finished sweep.
static SCORED: LazyLock<Snapshot> = LazyLock::new(|| {
    let bench = tiny();
    bench.ok("sweep which.toml -q");
    Snapshot::of(&bench.path("which.sweep"))
});

/// Test folder with the scene and the file of a sweep over it, which has not run.
fn tiny() -> Bench {
    let bench = Bench::new();
    bench.write("tiny.toml", TINY);
    bench.write("which.toml", SWEEP);
    bench
}

/// Test folder with the scene, the file of its sweep, and the finished sweep.
fn scored() -> Bench {
    let bench = tiny();
    SCORED.put(&bench.path("which.sweep"));
    bench
}

/// Bytes of the tables and the page of the sweep in `folder`.
fn bytes(bench: &Bench, folder: &str) -> Vec<Vec<u8>> {
    crate::support::sweeps::bytes(bench, folder)
}

/// Bytes of the tables and the page of an uninterrupted sweep.
fn reference() -> Vec<Vec<u8>> {
    bytes(&scored(), "which.sweep")
}

/// Number of claim files, held or left behind.
fn claims(bench: &Bench) -> usize {
    let entries = fs::read_dir(bench.path("which.sweep/claims")).expect("claims");
    let names = entries.map(|entry| entry.expect("readable").file_name());
    names
        .filter(|name| !name.to_string_lossy().starts_with('.'))
        .count()
}

/// Header of the recording at `path`, with the digest of the whole recording.
fn header(bench: &Bench, path: &str) -> String {
    fs::read_to_string(bench.path(path).join("dataset.toml")).expect("a recording")
}
