//! Tests of errors compared sample by sample, and of the reasons why they are not.

use super::{of_metric, score, study};
use serde_json::json;
use taceva_core::Unit;
use taceva_metrics::{DifferenceTest, Standing};
use taceva_report::{ReportPage, Study, report};
use taceva_results::Samples;

/// A study with a table of samples; `first` is the first truth, and every error is about `error`.
pub(super) fn sampled(sensor: &str, first: f64, error: f64) -> Study {
    sampled_at(12, sensor, first, error)
}

/// Study of [`sampled`], with its samples at `points` contact points.
pub(super) fn sampled_at(points: u32, sensor: &str, first: f64, error: f64) -> Study {
    let mut table = String::from("id,point_id,Fz,Fz_predicted\n");
    let (mut sum, rows) = (0.0, 48);
    for row in 0..rows {
        let truth = if row == 0 { first } else { f64::from(row) };
        let missed = error * (1.0 + f64::from(row % 5) / 8.0);
        sum += missed;
        table += &format!("s{row},p{},{truth},{}\n", row % points, truth + missed);
    }
    let mut mae = score(sum / f64::from(rows), 0.01, "N");
    mae["n"] = rows.into();
    let mut study = study(sensor, &[("mae", "Fz", mae)], &["Fz"]);
    study.samples = Some(Samples::read(&table).expect("samples"));
    study
}

#[test]
fn errors_are_compared_sample_by_sample_if_both_tables_are_of_the_same_samples_and_of_their_scores()
{
    let test = |a: Study, b: Study| {
        let comparison = of_metric(&[a, b], "mae");
        let difference = comparison.answers[0].difference.clone();
        difference.expect("tested").test.to_string()
    };
    let same = test(sampled("a", 0.0, 0.25), sampled("b", 0.0, 0.5));
    let other_truth = test(sampled("a", 0.0, 0.25), sampled("b", 0.5, 0.5));
    assert!(same.contains("sign"), "{same}");
    assert!(
        other_truth.contains("by the intervals of both"),
        "{other_truth}"
    );
    // Two sensors pressed by one plan share ids and commanded positions.
    let of = |name: &str, error, dataset: &str| {
        let mut study = sampled(name, 0.0, error);
        let entry = ("dataset".to_owned(), dataset.to_owned());
        study.provenance.push(entry);
        study
    };
    let same_plan = test(of("a", 0.25, "sha256:1"), of("b", 0.5, "sha256:2"));
    assert_eq!(same_plan, other_truth);
    let same_dataset = test(of("a", 0.25, "sha256:1"), of("b", 0.5, "sha256:1"));
    assert_eq!(same_dataset, same);
    // A table whose mean error differs from the score belongs to another result.
    let mut stranger = sampled("b", 0.0, 0.5);
    stranger.samples = sampled("b", 0.0, 0.75).samples;
    let strange = test(sampled("a", 0.0, 0.25), stranger);
    assert_eq!(strange, other_truth);
}

/// Test and notes of two studies whose results name these tables of truth.
fn of_tables(mut a: Study, mut b: Study, truths: [&str; 2]) -> (String, Vec<String>) {
    a.made.truth = Some(truths[0].to_owned());
    b.made.truth = Some(truths[1].to_owned());
    let comparison = of_metric(&[a, b], "mae");
    let difference = comparison.answers[0].difference.clone();
    (
        difference.expect("tested").test.to_string(),
        comparison.notes,
    )
}

#[test]
fn two_results_of_one_table_of_truth_are_compared_in_pairs_and_those_of_two_tables_are_not() {
    let [one, other] = ["sha256:1", "sha256:2"];
    let both = || (sampled("a", 0.0, 0.25), sampled("b", 0.0, 0.5));
    let (a, b) = both();
    let (test, notes) = of_tables(a, b, [one, one]);
    assert!(test.contains("sign"), "{test}");
    assert!(
        !notes.iter().any(|note| note.contains("pairs")),
        "{notes:?}"
    );
    // Two sensors share commanded positions bit by bit, in two tables.
    let (a, b) = both();
    let (test, notes) = of_tables(a, b, [one, other]);
    assert!(test.contains("by the intervals of both"), "{test}");
    assert!(
        !notes.iter().any(|note| note.contains("pairs")),
        "{notes:?}"
    );
}

#[test]
fn samples_of_one_truth_that_cannot_be_paired_are_said_to_be_none() {
    let lost = |mut study: Study| {
        study.samples = None;
        study
    };
    let without_points = |mut study: Study| {
        let table = "id,Fz,Fz_predicted\n";
        let rows = (0..48).map(|row| format!("s{row},{row},{}\n", f64::from(row) + 0.5));
        let table = format!("{table}{}", rows.collect::<String>());
        study.samples = Some(Samples::read(&table).expect("samples"));
        study
    };
    let twice = |mut study: Study| {
        let table = "id,point_id,Fz,Fz_predicted\n";
        let rows = (0..48).map(|row| format!("s{},p,{row},{}\n", row / 2, f64::from(row) + 0.5));
        let table = format!("{table}{}", rows.collect::<String>());
        study.samples = Some(Samples::read(&table).expect("samples"));
        study
    };
    let b = || sampled("b", 0.0, 0.5);
    for (b, reason) in [
        (
            lost(b()),
            "a table of samples is missing beside the result of b",
        ),
        (
            without_points(b()),
            "contact points are missing in the table of samples of b",
        ),
        (
            twice(b()),
            "a sample occurs twice in the table of samples of b",
        ),
        (
            sampled("b", 0.5, 0.5),
            "the two models predicted different samples",
        ),
    ] {
        let (test, notes) = of_tables(sampled("a", 0.0, 0.25), b, ["sha256:1"; 2]);
        assert!(test.contains("by the intervals of both"), "{test}");
        let expected = format!(
            "a and b predict the same truth but are not compared sample by sample: {reason}"
        );
        assert!(notes.contains(&expected), "{notes:?}");
    }
}

#[test]
fn equal_samples_in_other_clusters_are_not_compared_in_pairs_and_a_note_says_why() {
    let mut other = sampled("b", 0.0, 0.5);
    let mut table = String::from("id,point_id,Fz,Fz_predicted\n");
    for row in 0..48 {
        let missed = 0.5 * (1.0 + f64::from(row % 5) / 8.0);
        let truth = f64::from(row);
        // The same names and counts of points, on other rows.
        table += &format!("s{row},p{},{truth},{}\n", 11 - row % 12, truth + missed);
    }
    other.samples = Some(Samples::read(&table).expect("samples"));
    let comparison = of_metric(&[sampled("a", 0.0, 0.25), other], "mae");
    let difference = comparison.answers[0].difference.clone();
    let test = difference.expect("tested").test.to_string();
    assert!(test.contains("by the intervals of both"), "{test}");
    let reason = "their equal samples have different contact points; give both results the same contact points";
    let is_stated = comparison.notes.iter().any(|note| note.contains(reason));
    assert!(is_stated, "{:?}", comparison.notes);
}

#[test]
fn samples_that_are_taken_as_independent_are_paired_one_by_one() {
    let alone = |sensor: &str, error: f64| {
        let mut table = String::from("id,Fz,Fz_predicted\n");
        for row in 0..48 {
            let missed = error * (1.0 + f64::from(row % 5) / 8.0);
            table += &format!("s{row},{row},{}\n", f64::from(row) + missed);
        }
        let mut study = sampled(sensor, 0.0, error);
        let mut mae = score(study.scores[0].value.number().expect("a number"), 0.01, "N");
        mae["n"] = 48.into();
        mae["method"] = json!("jackknife, samples taken as independent, G=48, logarithmic");
        study.scores = self::study(sensor, &[("mae", "Fz", mae)], &["Fz"]).scores;
        study.samples = Some(Samples::read(&table).expect("samples"));
        study
    };
    let (test, _) = of_tables(alone("a", 0.25), alone("b", 0.5), ["sha256:1"; 2]);
    assert!(test.contains("sign"), "{test}");
}

#[test]
fn errors_are_summed_by_the_groups_that_the_interval_leaves_out() {
    let grouped = |sensor: &str, error: f64| {
        let mut study = sampled(sensor, 0.0, error);
        let mut mae = score(study.scores[0].value.number().expect("a number"), 0.01, "N");
        mae["n"] = 48.into();
        mae["method"] = json!("jackknife by group, G=8, logarithmic");
        study.scores = self::study(sensor, &[("mae", "Fz", mae)], &["Fz"]).scores;
        let samples = study.samples.as_mut().expect("samples");
        let group = |row: usize| Some(format!("object {}", row % 8));
        let groups = (0..samples.rows()).map(group).collect();
        samples.push_words(Samples::GROUP, groups);
        study
    };
    let comparison = of_metric(&[grouped("a", 0.25), grouped("b", 0.5)], "mae");
    let difference = comparison.answers[0].difference.as_ref();
    let test = difference.expect("tested").test;
    let by_group = matches!(test, DifferenceTest::SignFlip { clusters: 8, .. });
    assert!(by_group, "{test}");
}

/// A study of a shear force: errors of x are about `error`, those of y twice as large, and their mean is the score of the plane.
fn sheared(sensor: &str, error: f64) -> Study {
    let mut table = String::from("id,point_id,Fx,Fx_predicted,Fy,Fy_predicted\n");
    let (mut sum, rows) = (0.0, 48);
    for row in 0..rows {
        let (truth, missed) = (f64::from(row), error * (1.0 + f64::from(row % 5) / 8.0));
        sum += missed;
        let [x, y] = [truth + missed, truth - 2.0 * missed];
        table += &format!("s{row},p{},{truth},{x},{truth},{y}\n", row % 12);
    }
    let of = |times: f64| {
        let mut mae = score(times * sum / f64::from(rows), 0.01, "N");
        mae["n"] = rows.into();
        mae
    };
    let scores = [
        ("mae", "Fx", of(1.0)),
        ("mae", "Fy", of(2.0)),
        ("mae", "Fxy", of(1.5)),
    ];
    let mut study = study(sensor, &scores, &["Fx", "Fy", "Fxy"]);
    study.samples = Some(Samples::read(&table).expect("samples"));
    study.made.truth = Some("sha256:1".to_owned());
    study
}

#[test]
fn the_mean_over_a_plane_is_compared_sample_by_sample_as_its_axes_are() {
    let comparison = of_metric(&[sheared("a", 0.25), sheared("b", 0.28)], "mae");
    assert_eq!(comparison.answers.len(), 3);
    for answer in &comparison.answers {
        let difference = answer.difference.clone().expect("tested");
        let test = difference.test.to_string();
        assert!(test.contains("sign"), "{}: {test}", answer.channel);
        assert_eq!(answer.better(), Some(0), "{}", answer.channel);
    }
    let notes = comparison.notes.join("\n");
    assert!(!notes.contains("sample by sample"), "{notes}");
}

#[test]
fn a_sample_that_makes_most_of_the_squared_error_is_named_beside_a_model_without_skill() {
    let mut weak = sampled("weak", 0.0, 0.25);
    let row = |row: u32| format!("s{row},1,{}\n", if row == 7 { 9 } else { 2 });
    let rows: String = (0..60).map(row).collect();
    let table = format!("sample,Fz,Fz_predicted\n{rows}");
    weak.samples = Some(Samples::read(&table).expect("samples"));
    for score in &mut weak.scores {
        score.standing = Standing::NoSkill;
    }
    let comparison = of_metric(&[weak.clone(), sampled("b", 0.0, 0.5)], "mae");
    let expected =
        "weak: not better than predicting the mean (its sample s7 makes 52 % of the squared error)";
    let words = &comparison.decisions()[0].words;
    assert!(words.contains(expected), "{words}");
    let alone = report(&ReportPage {
        title: "weak",
        studies: std::slice::from_ref(&weak),
        pictures: &[],
        triples: &[],
    });
    assert!(alone.contains("Its sample s7 makes 52 % of"), "{alone}");
    // The difference of two angles is not an error if it wraps.
    for score in &mut weak.scores {
        score.unit = Unit::Degree;
    }
    let angle = report(&ReportPage {
        title: "weak",
        studies: &[weak],
        pictures: &[],
        triples: &[],
    });
    assert!(!angle.contains("Its sample"), "{angle}");
}

#[test]
fn a_score_that_its_table_does_not_give_is_named() {
    let mut stranger = sheared("b", 0.5);
    stranger.samples = sheared("b", 0.75).samples;
    let comparison = of_metric(&[sheared("a", 0.25), stranger], "mae");
    let expected = "a and b predict the same truth but are not compared sample by sample: the table of samples does not give the mae Fxy of b";
    let notes = &comparison.notes;
    assert!(notes.iter().any(|note| note == expected), "{notes:?}");
}
