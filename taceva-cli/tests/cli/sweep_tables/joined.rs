//! Shards scored by hand, merged to the result of one pass.

use std::fs;

use super::drawn::bench;
use super::{CSV, PARQUET, joined, one_pass};

#[test]
fn any_number_of_shards_joins_to_the_bytes_of_one_pass_for_csv_and_for_parquet() {
    for with_ids in [false, true] {
        let bench = bench(400, with_ids);
        for tables in [CSV, PARQUET] {
            let whole = one_pass(&bench, tables);
            for shards in [1, 2, 7] {
                let joined = joined(&bench, tables, shards);
                assert_eq!(joined, whole, "{tables}, {shards} shards, ids {with_ids}");
            }
        }
    }
}

#[test]
fn shards_of_tables_larger_than_what_is_read_at_once_join_to_the_bytes_of_one_pass() {
    let bench = bench(150_000, false);
    let whole = one_pass(&bench, CSV);
    assert_eq!(joined(&bench, CSV, 2), whole);
    let [scores, _] = &whole;
    assert!(scores.contains("\"n\": 150000"), "every row is scored");
    let of_columns = one_pass(&bench, PARQUET);
    assert_eq!(joined(&bench, PARQUET, 3), of_columns);
}

#[test]
fn predictions_in_another_order_find_their_rows_by_id_in_every_shard() {
    let bench = bench(300, true);
    let shuffled = |name: &str| {
        let text = fs::read_to_string(bench.path(name)).expect("text");
        let mut lines: Vec<&str> = text.lines().collect();
        let head = lines.remove(0);
        lines.sort_by_key(|line| {
            let id: u32 = line
                .split(',')
                .next()
                .and_then(|id| id.parse().ok())
                .expect("an id");
            id.wrapping_mul(2_654_435_761)
        });
        format!("{head}\n{}\n", lines.join("\n"))
    };
    let prediction = shuffled("pred.csv");
    bench.write("pred.csv", &prediction);
    let whole = one_pass(&bench, CSV);
    for shards in [1, 2, 7] {
        assert_eq!(joined(&bench, CSV, shards), whole);
    }
}

#[test]
fn more_shards_than_rows_leave_some_empty_and_join_all_the_same() {
    let bench = bench(5, false);
    let whole = one_pass(&bench, CSV);
    assert_eq!(joined(&bench, CSV, 12), whole);
}

#[test]
fn some_of_the_shards_say_how_many_rows_they_have_and_join_with_the_others_later() {
    let bench = bench(400, false);
    let [whole, _] = one_pass(&bench, CSV);
    joined(&bench, CSV, 4);
    let some = bench.json("merge 1.state 3.state --state-out some.state");
    let notes = some["provenance"]["notes"].to_string();
    assert!(notes.contains("200 of 400 rows"), "{notes}");
    let rest = bench.ok("merge some.state 4.state 2.state --format json -q");
    assert_eq!(rest, whole);
    bench.refused("merge some.state 3.state", 3, "100 rows of sha256:");
    let one = bench.json(&format!("score {CSV} --shard 2/4"));
    let notes = one["provenance"]["notes"].to_string();
    assert!(
        notes.contains("shard 2/4: rows 100 (from 0) up to but excluding 200, of 400"),
        "{notes}"
    );
}
