//! Tests of comparisons across splits.

use super::{errors, of_metric};
use taceva_report::{CompareRequest, Comparison, ScoreTable, Study};

/// Adds entries to the provenance of `study`.
fn state(study: &mut Study, entries: &[(&str, &str)]) {
    let entries = entries.iter();
    let entries = entries.map(|(key, text)| ((*key).to_owned(), (*text).to_owned()));
    study.provenance.extend(entries);
}

/// Comparison of two results with these datasets and splits.
fn compared(datasets: [&str; 2], splits: [&str; 2]) -> Comparison {
    let mut studies = errors(&[("Coarse", 0.75), ("Fine", 0.25)]);
    for (study, (dataset, split)) in studies.iter_mut().zip(datasets.into_iter().zip(splits)) {
        state(study, &[("dataset", dataset), ("split", split)]);
    }
    of_metric(&studies, "mae")
}

#[test]
fn no_verdict_stands_across_splits_of_one_dataset_by_different_groups() {
    let splits = ["loo by-column:object", "loo by-column:group"];
    let comparison = compared(["sha256:1", "sha256:1"], splits);
    let reason = comparison.answers[0].reason.as_deref().unwrap_or_default();
    assert!(
        reason.starts_with("the splits differ: Coarse has `loo by-column:object`"),
        "{reason}"
    );
    assert_eq!(comparison.decisions()[0].winner, None);
    let overview = comparison.overview(None);
    assert!(overview.contains("the splits differ (1)"), "{overview}");
}

#[test]
fn folds_of_the_same_groups_and_splits_of_other_datasets_are_compared() {
    let splits = ["cv:5 by-column:object", "cv:5 by-point"];
    let comparison = compared(["sha256:1", "sha256:2"], splits);
    assert_eq!(comparison.decisions()[0].winner, Some(1));
    let mut studies = errors(&[("Coarse", 0.75), ("Fine", 0.25)]);
    for (study, split) in studies.iter_mut().zip(["cv:5 by-point", "loo by-point"]) {
        state(study, &[("dataset", "sha256:1"), ("split", split)]);
        study.made.folds = Some("cross-validation by point".to_owned());
    }
    assert_eq!(of_metric(&studies, "mae").decisions()[0].winner, Some(1));
}

#[test]
fn no_verdict_stands_across_test_parts_of_one_dataset_and_the_remedy_is_named() {
    let of_seeds = |seeds: [&str; 2], split: &str| {
        let mut studies = errors(&[("Coarse", 0.75), ("Fine", 0.25)]);
        for (study, seed) in studies.iter_mut().zip(seeds) {
            let dataset = ("dataset", "sha256:1");
            state(
                study,
                &[dataset, ("split", split), ("seed", seed), ("part", "test")],
            );
        }
        of_metric(&studies, "mae")
    };
    let drawn = "by-point 70/20/10";
    let comparison = of_seeds(["1", "2"], drawn);
    let expected = "the test parts differ: Coarse was tested on part test, split by-point 70/20/10, seed 1, and Fine on part test, split by-point 70/20/10, seed 2; evaluate both with one --split, --seed and --part";
    assert_eq!(comparison.answers[0].reason.as_deref(), Some(expected));
    assert_eq!(comparison.decisions()[0].winner, None);
    let overview = comparison.overview(None);
    assert!(overview.contains("the test parts differ (1)"), "{overview}");
    for (seeds, split) in [
        (["1", "1"], drawn),
        (["1", "2"], "chronological 70/20/10"),
        (["1", "2"], "by-column:object=train:a;test:b"),
        (["1", "2"], "declared"),
    ] {
        let same = of_seeds(seeds, split);
        assert_eq!(same.decisions()[0].winner, Some(1), "{split}");
    }
    // All samples of a cross-validation, and a fifth of them.
    let splits = ["cv:5 by-point", drawn];
    let comparison = compared(["sha256:1", "sha256:1"], splits);
    assert_eq!(comparison.decisions()[0].winner, None);
}

#[test]
fn values_side_by_side_state_samples_clusters_and_split_of_each_result() {
    let mut studies = errors(&[("Coarse", 0.75), ("Fine", 0.25)]);
    for (study, seed) in studies.iter_mut().zip(["1", "2"]) {
        let split = ("split", "by-point 70/20/10");
        state(study, &[split, ("seed", seed), ("part", "test")]);
    }
    let request = CompareRequest::default();
    let text = |studies: &[Study]| {
        let table = ScoreTable::compared(studies, &request);
        table.side_by_side(studies, &request, false).text()
    };
    let said = text(&studies);
    for (name, seed) in [("Coarse", 1), ("Fine", 2)] {
        let part = format!("part test, split by-point 70/20/10, seed {seed}: {name}.");
        let line = said.lines().find(|line| line.ends_with(&part));
        let line = line.unwrap_or_else(|| panic!("no `{part}`: {said}"));
        assert!(line.starts_with("Tested on "), "{line}");
        assert!(
            line.contains(" samples in ") && line.contains(" clusters, "),
            "{line}"
        );
    }
    studies[1].provenance = studies[0].provenance.clone();
    let said = text(&studies);
    assert!(said.contains("seed 1: Coarse and Fine."), "{said}");
}
