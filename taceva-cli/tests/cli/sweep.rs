//! Sweeps: the same table by every way of running, and refusals.

mod again;
mod changed;
mod elsewhere;
mod failed;
mod labels;
mod one_node;
mod page;
mod refused;
mod same_bytes;
mod sealed;
mod stopped;
mod store;
mod too_many;

use std::fs;
use std::path::Path;

use crate::support::Bench;
use crate::support::sweeps::SWEEP;
use store::WEEK;

/// Test folder with two recordings, and the file of a sweep over both.
fn week() -> Bench {
    let bench = Bench::new();
    WEEK.put(&bench.path("."));
    bench
}

/// Writes the file of a sweep of eight tasks, after the replacements `changed` (old text, new text).
fn small(bench: &Bench, changed: &[(&str, &str)]) {
    let mut text = SWEEP
        .replace("\"1-3\"", "[1]")
        .replace("[\"monday\", \"tuesday\"]", "[\"monday\"]");
    for (old, new) in changed {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    bench.write("which.toml", &text);
}

fn text(bench: &Bench, name: &str) -> String {
    fs::read_to_string(bench.path(name)).expect(name)
}

/// Number of files in `folder`, without partial ones.
fn count(folder: &Path) -> usize {
    fs::read_dir(folder).map_or(0, |entries| {
        let names = entries.map(|entry| entry.expect("readable").file_name());
        names
            .filter(|name| !name.to_string_lossy().starts_with('.'))
            .count()
    })
}
