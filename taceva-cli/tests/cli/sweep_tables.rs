//! Shards of tables give the scores of one pass, byte for byte, in any number, in one process or by a list of tasks.

mod drawn;
mod joined;
mod refused;
mod swept;

use std::fs;

use crate::support::Bench;

const CSV: &str = "--truth truth.csv --pred pred.csv --sensor sensor.toml";
const PARQUET: &str = "--truth truth.parquet --pred pred.parquet --sensor sensor.toml";

/// Scores tables in one pass. Returns the scores and the state.
fn one_pass(bench: &Bench, tables: &str) -> [String; 2] {
    let scores = bench.ok(&format!(
        "score {tables} --state-out whole.state --force --format json -q"
    ));
    [
        scores,
        fs::read_to_string(bench.path("whole.state")).expect("a state"),
    ]
}

/// Scores tables in `shards` shards, and merges them in reverse order. Returns the scores and the state.
fn joined(bench: &Bench, tables: &str, shards: u32) -> [String; 2] {
    let mut states = Vec::new();
    for number in 1..=shards {
        let state = format!("{number}.state");
        bench.ok(&format!(
            "score {tables} --shard {number}/{shards} --state-out {state} --force -q"
        ));
        states.insert(0, state);
    }
    let states = states.join(" ");
    let scores = bench.ok(&format!(
        "merge {states} --state-out joined.state --force --format json -q"
    ));
    [
        scores,
        fs::read_to_string(bench.path("joined.state")).expect("a state"),
    ]
}
