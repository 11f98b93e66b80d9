//! Initial folders of several tests, made once.

use std::sync::LazyLock;

use super::{small, week};
use crate::support::Bench;
use crate::support::snapshot::Snapshot;
use crate::support::sweeps;

/// The two recordings, and the file of the sweep over both.
pub(crate) static WEEK: LazyLock<Snapshot> =
    LazyLock::new(|| Snapshot::of(&sweeps::week("").path(".")));

/// The sweep over both by one worker: its folder, and what was printed.
pub(crate) static WHOLE: LazyLock<(Snapshot, String)> = LazyLock::new(|| {
    let bench = week();
    let out = bench.ok("sweep which.toml --out one --jobs 1 -q");
    (Snapshot::of(&bench.path("one")), out)
});

/// The folder of the small sweep, scored.
static SMALL: LazyLock<Snapshot> = LazyLock::new(|| {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q");
    Snapshot::of(&bench.path("which.sweep"))
});

/// Both recordings, and the sweep over both by one worker in `one`.
pub(crate) fn whole() -> Bench {
    let bench = week();
    WHOLE.0.put(&bench.path("one"));
    bench
}

/// Both recordings, and the small sweep in `which.sweep`, scored.
pub(crate) fn scored() -> Bench {
    let bench = week();
    small(&bench, &[]);
    SMALL.put(&bench.path("which.sweep"));
    bench
}

/// Final bytes of the small sweep.
pub(crate) fn small_bytes() -> Vec<Vec<u8>> {
    let bench = Bench::new();
    SMALL.put(&bench.path("small"));
    sweeps::bytes(&bench, "small")
}
