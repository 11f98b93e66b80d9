//! Folders with which several tests start, each made once.

use std::sync::LazyLock;

use super::{small, week};
use crate::support::Bench;
use crate::support::snapshot::Snapshot;
use crate::support::sweeps;

/// Two recordings, and the file of a sweep over them.
pub(crate) static WEEK: LazyLock<Snapshot> =
    LazyLock::new(|| Snapshot::of(&sweeps::week("").path(".")));

/// Folder of a sweep over both recordings by one worker, and its printed text.
pub(crate) static WHOLE: LazyLock<(Snapshot, String)> = LazyLock::new(|| {
    let bench = week();
    let out = bench.ok("sweep which.toml --out one --jobs 1 -q");
    (Snapshot::of(&bench.path("one")), out)
});

/// Folder of the finished small sweep.
static SMALL: LazyLock<Snapshot> = LazyLock::new(|| {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q");
    Snapshot::of(&bench.path("which.sweep"))
});

/// Test folder with two recordings, and in `one` a finished sweep over them by one worker.
pub(crate) fn whole() -> Bench {
    let bench = week();
    WHOLE.0.put(&bench.path("one"));
    bench
}

/// Test folder with two recordings, and in `which.sweep` the finished small sweep.
pub(crate) fn scored() -> Bench {
    let bench = week();
    small(&bench, &[]);
    SMALL.put(&bench.path("which.sweep"));
    bench
}

/// Bytes of the tables and the page of the small sweep.
pub(crate) fn small_bytes() -> Vec<Vec<u8>> {
    let bench = Bench::new();
    SMALL.put(&bench.path("small"));
    sweeps::bytes(&bench, "small")
}
