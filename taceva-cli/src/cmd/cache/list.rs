//! `taceva cache list`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use anyhow::Context as _;
use serde_json::{Value, json};
use taceva_evaluate::{CacheEntry, cache_entries};
use taceva_report::Table;

use crate::amount::{age, bytes};
use crate::args::CacheList;
use crate::cmd::results;
use crate::{exit, output};

/// Default folder of numbered runs.
const RUNS: &str = "runs";
/// File of a run that lists its stages.
const STAGES: &str = "stages.json";
/// Number of digits of a key that are shown.
const SHORT: usize = 12;

pub(super) fn run(args: &CacheList) -> anyhow::Result<u8> {
    output::check_all_free(&args.output.path, args.output.force)?;
    let folder = super::folder_of(args.cache.path.clone())?;
    let entries = cache_entries(&folder)
        .with_context(|| format!("cannot read {}", taceva_core::shown(&folder)))?;
    let used = runs_of(&args.runs)?;
    let now = SystemTime::now();
    let table = match args.entries {
        true => one_by_one(&folder, &entries, &used, now),
        false => by_kind(&folder, &entries, &used, now),
    };
    results::write(&table, &args.output, || {
        json_of(&folder, &entries, &used, now)
    })?;
    Ok(exit::DONE)
}

/// Names of the runs that used an entry, by the key of the entry.
type Used = BTreeMap<String, Vec<String>>;

fn runs_of(named: &[PathBuf]) -> anyhow::Result<Used> {
    let mut used = Used::new();
    for folder in named {
        let stages = folder.join(STAGES);
        let text = fs::read_to_string(&stages).with_context(|| {
            format!(
                "cannot read {}; expected the folder of a run with a cache",
                taceva_core::shown(&stages)
            )
        })?;
        note(&text, folder, &mut used).with_context(|| taceva_core::shown(&stages).to_string())?;
    }
    for entry in fs::read_dir(RUNS).into_iter().flatten().flatten() {
        // A folder that is not a run has no stages.
        if let Ok(text) = fs::read_to_string(entry.path().join(STAGES)) {
            drop(note(&text, &entry.path(), &mut used));
        }
    }
    for runs in used.values_mut() {
        runs.sort();
        runs.dedup();
    }
    Ok(used)
}

fn note(text: &str, run: &Path, used: &mut Used) -> anyhow::Result<()> {
    let read: Value = serde_json::from_str(text)?;
    let stages = read["stages"]
        .as_array()
        .context("`stages`: expected a list")?;
    for key in stages.iter().filter_map(|stage| stage["key"].as_str()) {
        let digits = key.rsplit(':').next().unwrap_or(key);
        let runs = used.entry(digits.to_owned()).or_default();
        runs.push(taceva_core::shown(&run).to_string());
    }
    Ok(())
}

fn by_kind(folder: &Path, entries: &[CacheEntry], used: &Used, now: SystemTime) -> Table {
    let head = [
        "kind",
        "entries",
        "files",
        "size",
        "freed by removing",
        "longest unused",
        "in runs",
    ];
    let mut table = Table::new(caption(folder), head);
    let mut kinds: Vec<&str> = entries.iter().map(CacheEntry::kind).collect();
    kinds.dedup();
    for kind in kinds {
        let of: Vec<&CacheEntry> = entries
            .iter()
            .filter(|entry| entry.kind() == kind)
            .collect();
        let in_runs = of
            .iter()
            .filter(|entry| used.contains_key(&entry.name))
            .count();
        table.push([
            kind.to_owned(),
            of.len().to_string(),
            of.iter().map(|entry| entry.files).sum::<u64>().to_string(),
            bytes(of.iter().map(|entry| entry.bytes).sum()),
            bytes(of.iter().map(|entry| entry.own_bytes).sum()),
            age(of
                .iter()
                .map(|entry| entry.age(now))
                .max()
                .unwrap_or(Duration::ZERO)),
            in_runs.to_string(),
        ]);
    }
    close(&mut table, entries);
    table
}

fn one_by_one(folder: &Path, entries: &[CacheEntry], used: &Used, now: SystemTime) -> Table {
    let head = ["kind", "key", "files", "size", "unused for", "runs"];
    let mut table = Table::new(caption(folder), head);
    for entry in entries {
        table.push([
            entry.kind().to_owned(),
            entry.name.chars().take(SHORT).collect(),
            entry.files.to_string(),
            bytes(entry.bytes),
            age(entry.age(now)),
            used.get(&entry.name)
                .map_or_else(|| "–".to_owned(), |runs| runs.join(", ")),
        ]);
    }
    close(&mut table, entries);
    table
}

fn caption(folder: &Path) -> String {
    format!("Cache in {}", taceva_core::shown(&folder))
}

fn close(table: &mut Table, entries: &[CacheEntry]) {
    let all = entries.iter().map(|entry| entry.bytes).sum();
    let own = entries.iter().map(|entry| entry.own_bytes).sum();
    table.note(match entries.is_empty() {
        true => "The cache is empty.".to_owned(),
        false => format!("{} in total; {} are not shared with any run. `taceva cache prune` removes entries by age or total size.", bytes(all), bytes(own)),
    });
}

fn json_of(folder: &Path, entries: &[CacheEntry], used: &Used, now: SystemTime) -> String {
    let entry = |entry: &CacheEntry| {
        json!({
            "kind": entry.kind(),
            "key": entry.name,
            "files": entry.files,
            "bytes": entry.bytes,
            "own_bytes": entry.own_bytes,
            "unused_s": entry.age(now).as_secs(),
            "runs": used.get(&entry.name).cloned().unwrap_or_default(),
        })
    };
    let whole = json!({
        "schema": "taceva.cache/1",
        "folder": folder.display().to_string(),
        "entries": entries.iter().map(entry).collect::<Vec<_>>(),
    });
    format!("{whole:#}\n")
}
