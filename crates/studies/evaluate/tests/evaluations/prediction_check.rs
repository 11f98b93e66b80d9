//! Tables of samples against the recording and the model file behind them.

use std::path::PathBuf;

use taceva_evaluate::{
    ModelChoice, PredictionCheck, Refit, check_predictions, evaluate, fit, refit,
};
use taceva_results::{Provenance, Samples};

use crate::taxels::{WORK, of, request};

/// An evaluation of a fitted model, with its table of samples as text.
struct Bench {
    folder: tempfile::TempDir,
    provenance: Provenance,
    table: String,
}

impl Bench {
    fn new() -> Bench {
        let folder = tempfile::tempdir().expect("a folder");
        let dataset = crate::taxel_drawing::record(&folder.path().join("data"), 600);
        let fitted = fit(&dataset, &request("ridge", &[]), None, WORK).expect("fitted");
        let saved = fitted.model.save(&folder.path().join("m.taceva"));
        saved.expect("room");
        let request = of(ModelChoice::Fitted(Box::new(fitted.model)));
        let report = evaluate(&dataset, &request, WORK).expect("scored").report;
        let mut table = Vec::new();
        let samples = report.samples.as_ref().expect("samples");
        samples.write(&mut table).expect("into memory");
        Bench {
            folder,
            provenance: report.provenance,
            table: String::from_utf8(table).expect("a text"),
        }
    }

    fn checked(&self, table: &str) -> PredictionCheck {
        let at = |name: &str| -> PathBuf { self.folder.path().join(name) };
        let samples = Samples::read(table).expect("a table");
        let datasets = [at("data")];
        check_predictions(&at("m.taceva"), &datasets, &self.provenance, &samples, WORK)
            .expect("comparable")
    }

    /// The table with another number in the third row of `column`.
    fn with(&self, column: &str, change: impl Fn(f64) -> f64) -> String {
        let mut lines: Vec<Vec<String>> = self
            .table
            .lines()
            .map(|line| line.split(',').map(str::to_owned).collect())
            .collect();
        let at = lines[0].iter().position(|name| name == column);
        let cell = &mut lines[3][at.expect("a column")];
        *cell = format!("{:?}", change(cell.parse().expect("a number")));
        let lines: Vec<String> = lines.iter().map(|cells| cells.join(",")).collect();
        lines.join("\n")
    }

    #[track_caller]
    fn differs(&self, table: &str, words: &str) {
        let PredictionCheck::Differs(found) = self.checked(table) else {
            panic!("{words}: no difference was found");
        };
        assert!(found.contains(words), "{found}");
    }
}

#[test]
fn a_table_is_equal_near_or_different_by_its_predictions() {
    let bench = Bench::new();
    let samples = bench.table.lines().count() - 1;
    let equal = PredictionCheck::Equal { samples };
    assert_eq!(bench.checked(&bench.table), equal);
    let near = bench.checked(&bench.with("Fz_predicted", |force| force + 1e-9));
    assert!(
        matches!(&near, PredictionCheck::Near { share, .. } if *share < 1e-6),
        "{near:?}"
    );
    let other = bench.with("Fz_predicted", |force| force + 0.1);
    bench.differs(
        &other,
        "1 difference from the predictions of the model, the first: Fz in line 4",
    );
}

#[test]
fn other_labels_and_samples_differ_whatever_was_predicted() {
    let bench = Bench::new();
    let label = bench.with("Fz", |force| force + 1e-9);
    bench.differs(&label, "the label Fz in line 4");
    let (head, last) = bench.table.trim_end().rsplit_once('\n').expect("rows");
    bench.differs(head, "of that part");
    let (name, cells) = last.split_once(',').expect("cells");
    bench.differs(&format!("{head}\nnot-{name},{cells}"), "is sample `not-");
}

#[test]
fn a_fit_by_the_card_gives_the_same_model_and_no_other_recording_is_taken() {
    let bench = Bench::new();
    let at = |name: &str| -> PathBuf { bench.folder.path().join(name) };
    let fitted = |data: &str| refit(&at("m.taceva"), &[at(data)], &bench.provenance, WORK);
    assert_eq!(fitted("data").expect("fitted"), Refit::Equal);
    crate::taxel_drawing::record(&at("other"), 400);
    let error = fitted("other").expect_err("another recording").to_string();
    assert!(error.starts_with("the recording is sha256:"), "{error}");
}
