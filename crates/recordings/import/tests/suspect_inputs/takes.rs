//! Tests of LeRobot episodes with the rows of two takes.

use std::fmt::Write as _;

use taceva_import::MapDraft;
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

use super::{FACTS, imported, lab, planned};

const INFO: &str = r#"{"codebase_version": "v2.1", "fps": 10, "data_path": "data/all.parquet", "features": {
"observation.state": {"dtype": "float64", "shape": [2], "names": ["Fx", "Fz"]},
"timestamp": {"dtype": "float64", "shape": [1]}, "episode_index": {"dtype": "int64", "shape": [1]}}}"#;

/// Row of a dataset: its episode, and its time in the episode, s.
#[derive(Clone, Copy)]
struct Row {
    episode: u32,
    time_s: f64,
}

/// Rows of one take of an episode, at 10 Hz.
fn take(episode: u32, tenths: std::ops::Range<u32>) -> Vec<Row> {
    let row = |tenth: u32| Row {
        episode,
        time_s: f64::from(tenth) * 0.1,
    };
    tenths.map(row).collect()
}

/// Folder of a LeRobot dataset of `rows` in one data file. Its description states `lengths`, the number of rows of each episode.
fn dataset(rows: &[Row], lengths: &[u32]) -> tempfile::TempDir {
    let mut episodes = String::new();
    for (episode, length) in lengths.iter().enumerate() {
        writeln!(
            episodes,
            "{{\"episode_index\": {episode}, \"length\": {length}}}"
        )
        .expect("in memory");
    }
    let folder = lab(&[("meta/info.json", INFO), ("meta/episodes.jsonl", &episodes)]);
    let columns = [
        WrittenColumn::new("observation.state", WrittenKind::Numbers(Some(2))),
        WrittenColumn::new("timestamp", WrittenKind::Number),
        WrittenColumn::new("episode_index", WrittenKind::Integer),
    ];
    std::fs::create_dir(folder.path().join("data")).expect("made");
    let path = folder.path().join("data/all.parquet");
    let mut writer = ParquetWriter::create(&path, &columns, &[]).expect("made");
    for (number, row) in (0_u32..).zip(rows) {
        let forces = [0.25, 0.5 * f64::from(number)].map(Cell::Number);
        let cells = vec![
            Cell::List(forces.to_vec()),
            Cell::Number(row.time_s),
            Cell::Integer(i128::from(row.episode)),
        ];
        writer.push(cells).expect("written");
    }
    writer.finish().expect("written");
    folder
}

fn map() -> String {
    format!(
        "map_version = 2\ntable = {{ file = \".\", format = \"lerobot\" }}\n[columns]\nFz = {{ from = \"observation.state[1]\", unit = \"N\" }}\n[time]\n\
         column = \"timestamp\"\nunit = \"s\"\nclock = \"monotonic\"\n{FACTS}"
    )
}

#[test]
fn two_takes_of_one_episode_are_refused_by_the_map_and_in_the_draft() {
    let counted = "episode 0 has 5 rows, but its description states 3";
    let anew = "row 3: `timestamp` does not increase within episode 0";
    for (rows, lengths, words) in [
        // A recording that was begun anew, with and without its second length.
        ([take(0, 0..3), take(0, 0..2)].concat(), &[3][..], counted),
        ([take(0, 0..3), take(0, 0..2)].concat(), &[5], anew),
        // One frame twice.
        (
            [take(0, 0..3), take(0, 2..4), take(1, 0..2)].concat(),
            &[5, 2],
            anew,
        ),
        // A second take behind another episode.
        (
            [take(0, 0..2), take(1, 0..4), take(0, 0..2)].concat(),
            &[4, 4],
            "row 6: `timestamp` does not increase within episode 0",
        ),
        // A take that was cut off.
        (
            [take(0, 0..4), take(1, 0..2)].concat(),
            &[4, 6],
            "episode 1 has 2 rows, but its description states 6",
        ),
    ] {
        let folder = dataset(&rows, lengths);
        let problem = planned(folder.path(), &map()).expect_err("refused");
        assert!(problem.contains(words), "no `{words}` in {problem}");
        let problem = MapDraft::of(folder.path()).expect_err("refused");
        assert!(problem.to_string().contains(words), "{problem}");
    }
}

#[test]
fn episodes_of_one_take_each_are_read_in_any_order_of_their_rows() {
    let rows = [take(1, 0..3), take(0, 0..2), take(1, 3..5)].concat();
    let folder = dataset(&rows, &[2, 5]);
    let forces = imported(folder.path(), &map(), "Fz");
    assert_eq!(forces, [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]);
}
