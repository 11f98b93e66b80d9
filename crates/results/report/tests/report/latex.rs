//! Tests that every table for papers compiles with `pdflatex`. Without `pdflatex`, they are skipped with the reason.

use crate::paper::assert_compiles;
use crate::support::drawn;
use taceva_core::Unit;
use taceva_report::{
    Acceptance, BenchMachine, BenchRecording, ChannelError, CompareRequest, Layout, LimitsFile,
    ModelBench, ModelRow, Need, ScoreTable, Study, accept, catalogue, choose, compare,
};

/// A name of all special characters of LaTeX, and of those in our own texts.
const NAME: &str =
    "a_b & 50 % #1 {x} $y$ ^2 ~ \\end{document} <\"'> | ² ³ µm · × ± − – … ≤ ≥ → ε σ é ö";

fn studies() -> [Study; 2] {
    [drawn(NAME, 60, 1.0), drawn("other", 60, 1.5)]
}

#[test]
fn scores_compile() {
    let table = ScoreTable::of(&studies());
    assert_compiles("scores", &table.for_papers(NAME).latex(Layout::Float));
    assert_compiles(
        "headlines",
        &table.headlines().for_papers("Drawn").latex(Layout::Float),
    );
}

#[test]
fn comparisons_compile() {
    let comparison = compare(&studies(), &CompareRequest::default());
    assert!(comparison.answers.len() > 10);
    // A sheet of paper is finite, so the table of every answer is split.
    let all = comparison.table();
    for rows in all.rows.chunks(30) {
        let mut part = all.clone();
        part.rows = rows.to_vec();
        assert_compiles("comparison", &part.latex(Layout::Float));
    }
}

#[test]
fn choices_and_the_catalogue_compile() {
    let needs = Need::parse("accurate shear, ambient light, rate >= 50 Hz").expect("needs");
    let choice = choose(&catalogue::all(), &needs);
    assert_compiles("choice", &choice.table().latex(Layout::Float));
    let all = catalogue::list(&catalogue::all());
    assert_compiles("catalogue", &all.latex(Layout::Float));
    let mut details = String::new();
    for sensor in catalogue::all() {
        details += &catalogue::details(&sensor).latex(Layout::Float);
        details += "\\clearpage\n";
    }
    assert_compiles("every sensor of the catalogue", &details);
}

#[test]
fn data_sheets_compile() {
    let study = drawn(NAME, 60, 1.0);
    for head in [
        "limits_version = 1\nname = \"line 50 %\"\n",
        "limits_version = 2\nname = \"line 50 %\"\n[decision]\nrule = \"guarded\"\n",
    ] {
        let limit = "[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 0.00001\n";
        let limits = LimitsFile::read(&format!("{head}{limit}")).expect("limits");
        let findings = accept(&study, &limits).expect("checks");
        let acceptance = Acceptance {
            limits: &limits,
            study: &study,
            findings: &findings,
            date: Some("2026-11-22"),
            pictures: None,
        };
        assert_compiles("acceptance", &acceptance.table().latex(Layout::Float));
    }
}

#[test]
fn benchmarks_of_models_compile() {
    let mut bench = ModelBench::new(BenchMachine::default(), BenchRecording::default());
    bench.recording.source = "simulated".to_owned();
    bench.rows.push(ModelRow {
        model: NAME.to_owned(),
        fit_s: 1e-7,
        errors: vec![ChannelError {
            channel: "Fz".to_owned(),
            unit: Unit::Newton,
            mae: 0.25,
            ci95: Some([-0.05, 0.55]),
            n: 40,
            beaten_by: Vec::new(),
        }],
        ..ModelRow::default()
    });
    assert_compiles("models", &bench.table().latex(Layout::Float));
}
