//! Tests of the noun for what differs between compared results.

use crate::support;
use taceva_report::{CompareRequest, Layout, ReportPage, ScoreTable, Study, compare, report};

/// Results of two models on one sensor.
fn models() -> [Study; 2] {
    [("ridge", 1.0), ("knn", 1.5)].map(|(model, scale)| {
        let mut result = support::results("GelSight", scale);
        result["provenance"]["model"]["name"] = model.into();
        support::study(&result)
    })
}

#[test]
fn models_of_one_sensor_are_called_models_in_every_output() {
    let studies = models();
    let table = ScoreTable::of(&studies);
    assert!(
        table
            .caption()
            .starts_with("Accuracy of 2 models of GelSight on "),
        "{}",
        table.caption()
    );
    let shown = table.headlines();
    let page = report(&ReportPage {
        title: "drawn",
        studies: &studies,
        pictures: &[],
        triples: &[],
    });
    let comparison = compare(&studies, &CompareRequest::default());
    let texts = [
        shown.for_pages().text(),
        shown.for_pages().markdown(),
        shown.for_papers("drawn").latex(Layout::Float),
        table.for_column("drawn").remove(0).latex(Layout::Column),
        page,
    ];
    for text in &texts {
        assert!(text.contains("better than every other model"), "{text}");
    }
    for text in texts.iter().chain([&comparison.page(&studies)]) {
        for words in ["2 sensors", "every other sensor", "best sensor"] {
            assert!(!text.contains(words), "{words}: {text}");
        }
    }
}

#[test]
fn a_title_has_the_range_of_numbers_of_samples_that_differ() {
    let mut studies = models();
    let title = |studies: &[Study]| ScoreTable::of(studies).headlines().title();
    assert!(
        title(&studies[..1]).starts_with(
            "Scores of GelSight (ridge) on 80 synthetic samples in 20 clusters by contact point"
        ),
        "{}",
        title(&studies[..1])
    );
    for score in &mut studies[0].scores {
        if score.metric == "mae" {
            score.n = 40;
        }
    }
    let title = title(&studies[..1]);
    assert!(
        title.ends_with(" n is 40 to 80 in 20 clusters by contact point."),
        "{title}"
    );
}
