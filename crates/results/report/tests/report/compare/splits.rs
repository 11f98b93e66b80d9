//! Tests of comparisons across splits.

use super::{errors, of_metric};
use taceva_report::Comparison;

/// Comparison of two results with these datasets and splits.
fn compared(datasets: [&str; 2], splits: [&str; 2]) -> Comparison {
    let mut studies = errors(&[("Coarse", 0.75), ("Fine", 0.25)]);
    for (study, (dataset, split)) in studies.iter_mut().zip(datasets.into_iter().zip(splits)) {
        let stated = [("dataset", dataset), ("split", split)];
        let stated = stated.map(|(key, text)| (key.to_owned(), text.to_owned()));
        study.provenance.extend(stated);
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
fn folds_and_shares_of_the_same_groups_and_other_datasets_are_compared() {
    for (datasets, splits) in [
        (
            ["sha256:1", "sha256:1"],
            ["cv:5 by-point", "by-point 70/20/10"],
        ),
        (
            ["sha256:1", "sha256:2"],
            ["cv:5 by-column:object", "cv:5 by-point"],
        ),
    ] {
        let comparison = compared(datasets, splits);
        assert_eq!(comparison.decisions()[0].winner, Some(1), "{splits:?}");
    }
}
