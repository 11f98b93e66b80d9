//! Tests of metrics whose comparison uses a variant instead of the value.

use super::{of_metric, score, study};
use taceva_report::{CompareRequest, ScoreTable, Study, compare};

/// A study of one score of Fz whose variant `name` has another value and interval.
pub(super) fn with_variant(
    sensor: &str,
    metric: &str,
    value: f64,
    name: &str,
    variant: f64,
) -> Study {
    let mut drawn = score(value, 0.001, "N");
    drawn[name] = score(variant, 0.01, "N");
    study(sensor, &[(metric, "Fz", drawn)], &["Fz"])
}

#[test]
fn equal_sensors_that_were_pressed_twice_and_ten_times_have_no_winner() {
    // The mean of standard deviations of two repeats is low by a fifth; the pooled ones are equal.
    let studies = [
        with_variant("Twice", "repeatability", 0.0807, "pooled", 0.1004),
        with_variant("Ten", "repeatability", 0.0980, "pooled", 0.0996),
    ];
    let comparison = of_metric(&studies, "repeatability");
    let decision = &comparison.decisions()[0];
    assert_eq!((decision.winner, decision.tied.len()), (None, 0));
    assert_eq!(
        decision.asked(),
        "repeatability.pooled Fz ↓",
        "what was compared is said"
    );
    assert_eq!(
        decision.words,
        "no winner; the best value, Ten, 0.0996 N, is not shown to be better"
    );
    // A result without the variant is compared by its value.
    let mut without = studies.clone();
    for score in without.iter_mut().flat_map(|study| &mut study.scores) {
        score.variants.clear();
    }
    let comparison = of_metric(&without, "repeatability");
    assert_eq!(comparison.decisions()[0].winner, Some(0));
}

#[test]
fn the_values_side_by_side_have_a_row_of_the_variant_that_the_answers_compare() {
    let studies = [
        with_variant("Twice", "repeatability", 0.0807, "pooled", 0.1004),
        with_variant("Ten", "repeatability", 0.0980, "pooled", 0.0996),
    ];
    let request = CompareRequest {
        metrics: vec!["repeatability".to_owned()],
        ..CompareRequest::default()
    };
    let table = ScoreTable::compared(&studies, &request);
    let table = table.side_by_side(&studies, &request, false);
    let rows = table.rows.iter().map(|row| row.plain());
    let rows: Vec<_> = rows
        .filter(|row| row[0].starts_with("repeatability"))
        .collect();
    let names: Vec<&str> = rows.iter().map(|row| row[0].as_str()).collect();
    let expected = ["repeatability Fz (N) ↓", "repeatability.pooled Fz (N) ↓"];
    assert_eq!(names, expected);
    assert!(rows[1][1].starts_with("0.10"), "{:?}", rows[1]);
}

#[test]
fn an_unevenness_that_is_no_more_than_chance_gives_no_verdict_and_says_why() {
    let mut studies = [
        with_variant("Few", "r_spatial", 0.3, "excess", 0.02),
        with_variant("Many", "r_spatial", 0.1, "excess", 0.08),
    ];
    let mut scores = studies[0].scores.iter_mut();
    let spatial = scores.find(|score| score.metric == "r_spatial");
    spatial.expect("drawn").standing = taceva_metrics::Standing::NotAboveNoiseFloor;
    let comparison = of_metric(&studies, "r_spatial");
    let decision = &comparison.decisions()[0];
    assert_eq!(decision.winner, None);
    assert!(
        decision.words.contains("Few: not above chance"),
        "{}",
        decision.words
    );
    let reason = comparison.answers[0].reason.as_deref().unwrap_or_default();
    assert!(reason.contains("not above chance"), "{reason}");
}

#[test]
fn a_softer_gel_differs_and_is_no_better() {
    let of = |sensor, value| {
        let sensitivity = score(value, 0.01, "mm/N");
        study(sensor, &[("sensitivity", "Fz", sensitivity)], &[])
    };
    let studies = [of("Soft", 3.0), of("Firm", 2.0)];
    let comparison = of_metric(&studies, "sensitivity");
    assert_eq!(comparison.answers[0].better(), None);
    let words = comparison.answers[0].words(&comparison.names);
    assert!(words.starts_with("Soft and Firm differ by 1.0"), "{words}");
    // Without a request, scores without a better direction are not compared.
    let comparison = compare(&studies, &CompareRequest::default());
    assert!(comparison.answers.is_empty(), "{:?}", comparison.answers);
}
