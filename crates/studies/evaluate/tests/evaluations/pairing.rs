//! Pairing of the rows of two tables by their keys.

mod independent;
mod periods;
mod units;

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{SilentProgress, Unit};
use taceva_evaluate::{
    EvaluateError, RowKey, ScoreRequest, ScoreTables, Scored, Scoring, Shard, score_in_one_pass,
};
use taceva_tables::{Cell, ParquetWriter, WrittenColumn, WrittenKind};

/// Tables of one test.
struct Tables {
    folder: tempfile::TempDir,
    request: ScoreRequest,
}

impl Tables {
    fn new(truth: &str, prediction: &str) -> Tables {
        let folder = tempfile::tempdir().expect("a folder");
        let request = ScoreRequest {
            truth: folder.path().join("truth.csv"),
            prediction: folder.path().join("pred.csv"),
            units: Vec::new(),
            periods: Vec::new(),
            key: None,
            is_independent: false,
            sensor: None,
            metrics: vec!["mae".to_owned()],
            allow_invalid: false,
            jobs: NonZeroUsize::MIN,
        };
        std::fs::write(&request.truth, truth).expect("written");
        std::fs::write(&request.prediction, prediction).expect("written");
        Tables { folder, request }
    }

    fn with_key(mut self, key: &str) -> Tables {
        self.request.key = Some(RowKey::from(key));
        self
    }

    /// The same rows in Parquet files, every cell as text except those of `Fz`.
    fn in_parquet(mut self) -> Tables {
        for path in [&mut self.request.truth, &mut self.request.prediction] {
            let to = self.folder.path().join(path.with_extension("parquet"));
            write_parquet(&to, &std::fs::read_to_string(&*path).expect("written"));
            *path = to;
        }
        self
    }

    /// Scores the tables with every reader that accepts them. Asserts equal results, and returns the last one.
    fn scored(&self) -> Scored {
        let whole = Scoring::read(self.request.clone()).expect("tables");
        let whole = whole.run(&SilentProgress).expect("scored");
        let tables = ScoreTables::scan(&self.request).expect("tables");
        let in_parts = tables.score(&self.request, Shard::WHOLE, &SilentProgress);
        let in_parts = in_parts.expect("scored");
        assert_eq!(whole.report, in_parts.report);
        if let Some(pass) = score_in_one_pass(&self.request, &SilentProgress).expect("not stopped")
        {
            assert_eq!(whole.report, pass.report);
        }
        whole
    }

    /// Error message, which is the same for tables in memory and in parts.
    fn refused(&self) -> String {
        let whole = Scoring::read(self.request.clone())
            .and_then(|tables| tables.run(&SilentProgress))
            .expect_err("refused");
        let in_parts = ScoreTables::scan(&self.request)
            .and_then(|tables| tables.score(&self.request, Shard::WHOLE, &SilentProgress));
        assert!(in_parts.is_err(), "{whole}");
        let pass = score_in_one_pass(&self.request, &SilentProgress).expect("not stopped");
        assert!(pass.is_none(), "{whole}");
        whole.to_string()
    }
}

fn write_parquet(path: &Path, text: &str) {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let columns: Vec<WrittenColumn> = names
        .iter()
        .map(|name| {
            let kind = match *name {
                "Fz" => WrittenKind::Number,
                _ => WrittenKind::Text,
            };
            WrittenColumn::new(*name, kind)
        })
        .collect();
    let mut writer = ParquetWriter::create(path, &columns, &[]).expect("made");
    for line in lines {
        let cells = line.split(',').zip(&names).map(|(cell, name)| match *name {
            "Fz" => Cell::Number(cell.parse().expect("a number")),
            _ => Cell::Text(cell.to_owned()),
        });
        writer.push(cells.collect()).expect("written");
    }
    writer.finish().expect("written");
}

#[test]
fn distances_beside_predictions_are_left_out_and_a_channel_of_that_name_needs_its_truth() {
    let prediction = "sample,Fz,distance\na,1,0.5\nb,2,0.75\n";
    let scored = Tables::new("sample,Fz\na,1\nb,2\n", prediction).scored();
    assert!(scored.report.score("mae", "Fz").is_some());
    assert!(scored.report.score("mae", "distance").is_none());
    let prediction = prediction.replace("sample", "id");
    let refused = Tables::new("id,Fz\na,1\nb,2\n", &prediction).refused();
    assert!(refused.contains("distance"), "{refused}");
}

/// Table with `header` and one row for each of `numbers`, in this order. `cells` gives the cells of a row from its number.
fn table(header: &str, numbers: &[u32], cells: impl Fn(u32) -> String) -> String {
    let mut text = format!("{header}\n");
    for number in numbers {
        writeln!(text, "{}", cells(*number)).expect("in memory");
    }
    text
}

const ORDER: [u32; 7] = [0, 1, 2, 3, 4, 5, 6];
const SHUFFLED: [u32; 7] = [4, 2, 6, 0, 5, 1, 3];

/// Error of every correctly paired prediction, in N.
const ERROR: f64 = 0.25;

fn truth_of(number: u32) -> f64 {
    f64::from(number * number)
}

fn mae(scored: &Scored) -> f64 {
    let score = scored.report.score("mae", "Fz").expect("scored");
    score.value.number().expect("defined")
}

fn notes(scored: &Scored) -> String {
    scored.report.provenance.notes.join("\n")
}

/// Truth in order, and shuffled predictions. `key` gives the key cells of both tables from the number of a row.
fn keyed(names: [&str; 2], key: impl Fn(u32) -> [String; 2]) -> Tables {
    let truth = table(&format!("{},Fz", names[0]), &ORDER, |number| {
        format!("{},{}", key(number)[0], truth_of(number))
    });
    let prediction = table(&format!("{},Fz", names[1]), &SHUFFLED, |number| {
        format!("{},{}", key(number)[1], truth_of(number) + ERROR)
    });
    Tables::new(&truth, &prediction)
}

#[test]
fn two_tables_with_a_shared_key_in_another_order_are_paired_by_it() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/pairing");
    let read = |name: &str| std::fs::read_to_string(data.join(name)).expect("there");
    let tables = Tables::new(&read("truth.csv"), &read("pred.csv"));
    for tables in [
        tables,
        Tables::new(&read("truth.csv"), &read("pred.csv")).in_parquet(),
    ] {
        let scored = tables.scored();
        // NumPy: mean(|truth − prediction|) after pandas.merge(on="sample").
        assert!((mae(&scored) - 0.095525).abs() < 1e-12, "{}", mae(&scored));
        assert!(notes(&scored).contains("rows were paired by `sample`"));
    }
    for name in ["sample", "id", "sample_id", "index", ""] {
        let same = |number: u32| [format!("press {number}"), format!("press {number}")];
        let scored = keyed([name, name], same).scored();
        assert_eq!(mae(&scored).to_bits(), ERROR.to_bits(), "{name}");
        let wanted = match name {
            "" => "rows were paired by the unnamed column".to_owned(),
            name => format!("rows were paired by `{name}`"),
        };
        assert!(notes(&scored).contains(&wanted), "{}", notes(&scored));
    }
}

#[test]
fn keys_of_two_names_and_of_numbers_written_as_decimals_pair_the_same_rows() {
    let scored = keyed(["sample", "id"], |number| {
        [format!("{number}"), format!("{number}.0")]
    })
    .scored();
    assert_eq!(mae(&scored).to_bits(), ERROR.to_bits());
    let wanted = "rows were paired by `sample` of the truth and `id` of the predictions";
    assert!(notes(&scored).contains(wanted), "{}", notes(&scored));
}

#[test]
fn rows_without_a_common_key_are_paired_by_order_and_it_is_said() {
    let scored = Tables::new("sample,Fz\na,1\nb,2\nc,3\n", "Fz\n1\n2\n4\n").scored();
    assert!(
        notes(&scored)
            .contains("rows were paired by order, because the tables share no key column"),
        "{}",
        notes(&scored)
    );
    let asked = Tables::new("id,Fz\n1,1\n2,2\n", "id,Fz\n8,1\n9,2\n").with_key("order");
    assert!(notes(&asked.scored()).contains("by order, as requested"));
}

#[test]
fn a_key_that_comes_twice_is_refused_with_both_lines() {
    for (truth, prediction, file) in [
        (
            "sample,Fz\n1,1\n2,2\n3,3\n10,4\n",
            "sample,Fz\n1,1\n2,2\n2,3\n10,4\n",
            "pred.csv",
        ),
        ("id,Fz\na,1\na,2\n", "id,Fz\na,1\nb,2\n", "truth.csv"),
        (
            "index;Fz\n7;1\n7.0;2\n",
            "index;Fz\n7;1\n8;2\n",
            "truth.csv",
        ),
    ] {
        let error = Tables::new(truth, prediction).refused();
        assert!(
            error.contains(file) && error.contains("occurs twice, in lines"),
            "{error}"
        );
        assert!(error.contains("--key"), "{error}");
    }
}

#[test]
fn a_row_without_its_key_is_refused() {
    let error = Tables::new("sample,Fz\n1,1\n,2\n", "sample,Fz\n1,1\n,2\n").refused();
    assert!(error.contains("line 3, column `sample`"), "{error}");
    assert!(error.contains("expected the key of the row"), "{error}");
}

#[test]
fn keys_that_differ_in_blanks_or_case_are_refused_with_both() {
    for [one, other] in [["press 1", "press1"], ["Press_1", "press_1"], ["P 1", "p1"]] {
        let truth = format!("sample,Fz\n{one},1\nb,2\n");
        let error = Tables::new(&truth, &format!("sample,Fz\n{other},1\nb,2\n")).refused();
        assert!(
            error.contains(&format!("no row with sample `{one}`")),
            "{error}"
        );
        assert!(
            error.contains(&format!("`{other}` differs only in blanks or case")),
            "{error}"
        );
    }
}

#[test]
fn two_keys_that_pair_rows_differently_are_refused_unless_one_is_chosen() {
    let truth = table("sample,index,Fz", &ORDER, |number| {
        format!("s{number},{number},{}", truth_of(number))
    });
    let mut rows = String::from("sample,index,Fz\n");
    for (place, number) in SHUFFLED.into_iter().enumerate() {
        writeln!(rows, "s{number},{place},{}", truth_of(number) + ERROR).expect("in memory");
    }
    let error = Tables::new(&truth, &rows).refused();
    assert!(
        error.contains("pred.csv, line 5, column `index`"),
        "{error}"
    );
    assert!(
        error.contains("paired by `sample`, but differ in index"),
        "{error}"
    );
    assert!(error.contains("--key"), "{error}");
    let scored = Tables::new(&truth, &rows).with_key("sample").scored();
    assert_eq!(mae(&scored).to_bits(), ERROR.to_bits());
}

#[test]
fn a_key_that_repeats_alike_gives_way_to_one_that_does_not() {
    let scored = keyed(["sample,index", "sample,index"], |number| {
        let cells = format!("object {},{number}", number % 2);
        [cells.clone(), cells]
    })
    .scored();
    assert_eq!(mae(&scored).to_bits(), ERROR.to_bits());
    assert!(notes(&scored).contains("rows were paired by `index`"));
}

#[test]
fn rows_that_disagree_in_time_point_or_picture_are_refused() {
    for (name, one, other) in [
        ("t_s", "0.30", "0.32"),
        ("t_s", "1", "1.02"),
        ("point_id", "p1", "p2"),
        ("frame_sha256", "0a", "0b"),
        ("scene", "dark", "bright"),
        ("repeat", "1", "2"),
    ] {
        let truth = format!("{name},Fz\n{one},1\n{one},2\n");
        let error = Tables::new(&truth, &format!("{name},Fz\n{one},1\n{other},2\n")).refused();
        assert!(
            error.contains(&format!("line 3, column `{name}`")),
            "{error}"
        );
        assert!(error.contains("paired by order"), "{error}");
    }
    // Rounded times and names that one table lacks are no contradiction.
    let rounded = Tables::new("t_s,Fz\n0.3333333,1\n0.5,2\n", "t_s,Fz\n0.333,1\n,2\n");
    assert_eq!(mae(&rounded.scored()).to_bits(), 0.0_f64.to_bits());
}

#[test]
fn a_column_of_whole_numbers_that_names_rows_is_asked_about_and_never_scored() {
    let tables = || {
        keyed(["frame_number", "frame_number"], |number| {
            [format!("{number}"), format!("{number}")]
        })
    };
    for tables in [tables(), tables().in_parquet()] {
        let error = tables.refused();
        assert!(
            error.contains("`frame_number` holds the same unique whole numbers"),
            "{error}"
        );
        assert!(error.contains("--key frame_number"), "{error}");
        let scored = tables.with_key("frame_number").scored();
        assert_eq!(mae(&scored).to_bits(), ERROR.to_bits());
        assert!(scored.report.score("mae", "frame_number").is_none());
    }
    let mut declared = tables();
    declared.request.units = vec![("frame_number".to_owned(), Unit::One)];
    assert!(
        declared
            .scored()
            .report
            .score("mae", "frame_number")
            .is_some()
    );
    // Predicted counts repeat, or differ from the truth: they are scored as channels.
    let counts = Tables::new(
        "Fz,fingers\n0,1\n1,2\n2,2\n3,1\n4,3\n",
        "Fz,fingers\n0,1\n1,2\n2,2\n3,1\n4,3\n",
    );
    assert!(counts.scored().report.score("mae", "fingers").is_some());
}

#[test]
fn a_column_of_texts_is_named_as_the_likely_key() {
    let tables = || {
        keyed(["press", "press"], |number| {
            [format!("no. {number}"), format!("no. {number}")]
        })
    };
    let error = tables().refused();
    assert!(
        error.contains("column `press` holds texts such as `no. "),
        "{error}"
    );
    assert!(error.contains("--key press"), "{error}");
    let scored = tables().with_key("press").scored();
    assert_eq!(mae(&scored).to_bits(), ERROR.to_bits());
    let missing = tables().with_key("pres").refused();
    assert!(missing.contains("no column `pres`"), "{missing}");
}

#[test]
fn a_shard_of_shuffled_rows_has_the_predictions_of_its_keys() {
    let tables = keyed(["sample", "sample"], |number| {
        [format!("s{number}"), format!("s{number}")]
    });
    let scanned = ScoreTables::scan(&tables.request).expect("tables");
    let mut states: Vec<PathBuf> = Vec::new();
    for number in 1..=3 {
        let shard = Shard::new(number, 3).expect("a shard");
        let scored = scanned.score(&tables.request, shard, &SilentProgress);
        let path = tables.folder.path().join(format!("{number}.state"));
        let mut bytes = Vec::new();
        let scored: Result<Scored, EvaluateError> = scored;
        scored
            .expect("scored")
            .state
            .write(&mut bytes)
            .expect("in memory");
        std::fs::write(&path, bytes).expect("written");
        states.push(path);
    }
    let (report, _) = taceva_evaluate::merge(&states).expect("merged");
    assert_eq!(report, tables.scored().report);
}
