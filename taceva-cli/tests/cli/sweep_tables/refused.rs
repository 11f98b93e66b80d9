//! Invalid shards and unreadable tables are refused by their place.

use std::fs;

use super::drawn::{bench, write_parquet};
use super::{CSV, PARQUET};

#[test]
fn a_shard_that_is_none_is_refused_with_what_would_be_one() {
    let bench = bench(10, false);
    for (shard, problem) in [
        ("0/7", "shard numbers begin at 1"),
        ("8/7", "K is above N"),
        ("1/0", "the number of shards is 0"),
        ("half", "expected K/N"),
    ] {
        let ran = bench.run(&format!("score {CSV} --shard {shard} -q"));
        assert_eq!(ran.code, 2, "{shard}: {}", ran.err);
        assert!(ran.err.contains(problem), "{shard}: {}", ran.err);
    }
    let ran = bench.run(&format!("score {CSV} --shard 1/2 --samples-out s.csv -q"));
    assert_eq!(ran.code, 2, "{}", ran.err);
    let plan = bench.ok(&format!("score {CSV} --shard 1/2 --explain"));
    assert!(
        plan.contains("rows 0 up to but excluding 5, of 10"),
        "{plan}"
    );
}

#[test]
fn bad_cells_ids_and_lengths_are_refused_by_their_place_in_the_file() {
    let bench = bench(100, true);
    let truth = fs::read_to_string(bench.path("truth.csv")).expect("text");
    bench.write("truth.csv", &truth.replacen("\n90,p16,", "\n90,p16,x", 1));
    bench.refused(
        &format!("score {CSV} --shard 2/2"),
        3,
        "truth.csv, line 92, column `Px`",
    );
    bench.ok(&format!("score {CSV} --shard 1/2 -q"));
    // Another shard has the same id.
    bench.write("truth.csv", &truth.replacen("\n90,", "\n7,", 1));
    bench.refused(
        &format!("score {CSV} --shard 2/2"),
        3,
        "id `7` occurs twice",
    );
    bench.write("truth.csv", &truth.replacen("\n90,", "\n900,", 1));
    bench.refused(
        &format!("score {CSV} --shard 2/2"),
        3,
        "no row with id `900`",
    );
    bench.write("truth.csv", &(truth.clone() + "100,p1,0,0,0.2,0.2\n"));
    bench.refused(
        &format!("score {CSV} --shard 1/2"),
        3,
        "100 rows, but truth.csv has 101",
    );
    // In Parquet tables the place is a row.
    fs::remove_file(bench.path("truth.parquet")).expect("removed");
    write_parquet(
        &bench.path("truth.parquet"),
        &truth.replacen("\n90,p16,-4.5,", "\n90,p16,inf,", 1),
    );
    let ran = bench.run(&format!("score {PARQUET} --shard 2/2 -q"));
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("truth.parquet, row 90"), "{}", ran.err);
}
