//! Shards of tables: of any number, here and by a list, they end in the scores of one pass, byte for byte.

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;

use support::Bench;
use support::sweeps::tables;
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

const CSV: &str = "--truth truth.csv --pred pred.csv --sensor sensor.toml";
const PARQUET: &str = "--truth truth.parquet --pred pred.parquet --sensor sensor.toml";
const SENSOR: &str = "model = \"drawn\"\nopaque = true\n\n[footprint]\nshape = \"rect\"\nhalf_x_mm = 5.0\nhalf_y_mm = 5.0\ndepth_max_mm = 1.0\n";
const SWEEP: &str = "sweep_version = 1\nsensor = \"sensor.toml\"\n[score]\ntruth = \"truth.csv\"\npred = \"pred.csv\"\nshards = 7\n";

/// Both tables as CSV and as Parquet, of more rows than are read at once where there are many.
fn bench(rows: u32, with_ids: bool) -> Bench {
    let bench = Bench::new();
    bench.write("sensor.toml", SENSOR);
    bench.write("which.toml", SWEEP);
    for (name, text) in ["truth", "pred"].into_iter().zip(tables(rows, with_ids)) {
        bench.write(&format!("{name}.csv"), &text);
        write_parquet(&bench.path(&format!("{name}.parquet")), &text);
    }
    bench
}

fn write_parquet(path: &Path, text: &str) {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let kind = |name: &str| match name {
        "id" => WrittenKind::Integer,
        "point_id" => WrittenKind::Text,
        _ => WrittenKind::Number,
    };
    let columns = names
        .iter()
        .map(|name| WrittenColumn::new(*name, kind(name)));
    let columns: Vec<WrittenColumn> = columns.collect();
    let mut writer = ParquetWriter::create(path, &columns, &[]).expect("made");
    for line in lines {
        let cells = line.split(',').zip(&names).map(|(cell, name)| match *name {
            "id" => Cell::Integer(cell.parse().expect("a number")),
            "point_id" => Cell::Text(cell.to_owned()),
            _ => Cell::Number(cell.parse().expect("a number")),
        });
        writer.push(cells.collect()).expect("written");
    }
    writer.finish().expect("written");
}

/// The scores of one pass, and its state.
fn one_pass(bench: &Bench, tables: &str) -> [String; 2] {
    let scores = bench.ok(&format!(
        "score {tables} --state-out whole.state --force --format json -q"
    ));
    [
        scores,
        fs::read_to_string(bench.path("whole.state")).expect("a state"),
    ]
}

/// The same of so many shards, joined in the reverse of their order.
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
        notes.contains("shard 2/4: rows 100 to before 200 of 400"),
        "{notes}"
    );
}

#[test]
fn a_shard_that_is_none_is_refused_with_what_would_be_one() {
    let bench = bench(10, false);
    for (shard, problem) in [
        ("0/7", "shards count from 1"),
        ("8/7", "there are fewer shards"),
        ("1/0", "there is no shard"),
        ("half", "expected K/N"),
    ] {
        let ran = bench.run(&format!("score {CSV} --shard {shard} -q"));
        assert_eq!(ran.code, 2, "{shard}: {}", ran.err);
        assert!(ran.err.contains(problem), "{shard}: {}", ran.err);
    }
    let ran = bench.run(&format!("score {CSV} --shard 1/2 --samples-out s.csv -q"));
    assert_eq!(ran.code, 2, "{}", ran.err);
    let plan = bench.ok(&format!("score {CSV} --shard 1/2 --explain"));
    assert!(plan.contains("rows 0 to before 5 of the 10"), "{plan}");
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
    // An id that another shard has too.
    bench.write("truth.csv", &truth.replacen("\n90,", "\n7,", 1));
    bench.refused(&format!("score {CSV} --shard 2/2"), 3, "id `7` comes twice");
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
    // Of columns, by row.
    fs::remove_file(bench.path("truth.parquet")).expect("removed");
    write_parquet(
        &bench.path("truth.parquet"),
        &truth.replacen("\n90,p16,-4.5,", "\n90,p16,inf,", 1),
    );
    let ran = bench.run(&format!("score {PARQUET} --shard 2/2 -q"));
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("truth.parquet, row 90"), "{}", ran.err);
}

#[test]
fn a_sweep_of_shards_here_and_by_a_list_ends_in_the_bytes_of_one_pass() {
    let bench = bench(400, true);
    let [whole, _] = one_pass(&bench, CSV);
    let out = bench.ok("sweep which.toml --jobs 2 -q");
    assert!(out.contains("7 scored, 0 failed, 0 missing"), "{out}");
    let read =
        |folder: &str| fs::read_to_string(bench.path(folder).join("score.json")).expect("scores");
    assert_eq!(read("which.sweep"), whole);
    let digest = taceva_dataset::Digest::of(whole.as_bytes()).to_string();
    assert!(out.contains(&format!("digest   {digest}")), "{out}");
    let part = bench.run("sweep which.toml --out parts -q --only shard=2/7");
    assert!(
        part.out.contains("1 scored, 0 failed, 6 missing"),
        "{}",
        part.out
    );
    assert!(
        part.out.contains("none before every shard is scored"),
        "{}",
        part.out
    );
    let lines = bench.ok("sweep which.toml --out parts -q --on list");
    assert_eq!(
        lines.lines().count(),
        7,
        "six tasks and one that collects: {lines}"
    );
    let program = Path::new(env!("CARGO_BIN_EXE_taceva"))
        .parent()
        .expect("a folder");
    let path = format!(
        "{}:{}",
        program.display(),
        std::env::var("PATH").expect("a path")
    );
    let mut shell = Command::new("sh");
    shell.args(["-c", &lines]).current_dir(bench.path("."));
    let output = shell.env("PATH", path).output().expect("a shell");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert_eq!(read("parts"), whole);
    bench.refused("sweep show which.toml", 2, "score.json");
}

#[test]
fn a_table_that_changes_between_submission_and_execution_fails_its_tasks_and_says_so() {
    let bench = bench(400, false);
    bench.run("sweep which.toml -q --only shard=1/7");
    let [truth, prediction] = tables(400, false);
    bench.write("pred.csv", &prediction.replacen("\n", "\n1,1,1,1\n", 1));
    let ran = bench.run("sweep task which.sweep --tasks which.sweep/tasks.json --at 1");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.err
            .contains("another table than when the sweep was planned"),
        "{}",
        ran.err
    );
    // Written anew with the same bytes it is the same table.
    bench.write("pred.csv", &prediction);
    bench.write("truth.csv", &truth);
    bench.ok("sweep task which.sweep --tasks which.sweep/tasks.json --at 1,2 --retry-failed -q");
}

#[test]
fn tables_beside_recordings_and_tables_that_do_not_fit_are_refused_at_the_start() {
    let bench = bench(10, false);
    for (more, message) in [
        (
            "datasets = [\"monday\"]\n",
            "line 1: `datasets` stands beside `[score]`",
        ),
        (
            "models = [\"ridge\"]\n",
            "line 1: `models` stands beside `[score]`",
        ),
        ("seeds = [1]\n", "line 1: `seeds` stands beside `[score]`"),
        (
            "limits = \"limits.toml\"\n",
            "line 1: `limits` stands beside `[score]`",
        ),
    ] {
        bench.write("which.toml", &format!("{more}{SWEEP}"));
        bench.refused("sweep which.toml", 3, message);
    }
    for (old, new, message) in [
        (
            "shards = 7",
            "shards = 0",
            "line 6: `shards = 0`: expected a number from 1",
        ),
        ("shards = 7", "shard = 7", "did you mean `shards`?"),
        (
            "shards = 7",
            "shards = 7\nunits = { Fz = \"stone\" }",
            "no unit `stone`",
        ),
        ("truth.csv", "sensor.toml", "sensor.toml"),
    ] {
        bench.write("which.toml", &SWEEP.replace(old, new));
        bench.refused("sweep which.toml", 3, message);
    }
    bench.write("which.toml", SWEEP);
    let [_, prediction] = tables(9, false);
    bench.write("pred.csv", &prediction);
    bench.refused("sweep which.toml", 3, "9 rows, but");
    assert!(!bench.path("which.sweep").exists());
}
