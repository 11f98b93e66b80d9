//! Tests of requested metrics, and of metrics of another version.

use super::pairs::sampled;
use super::{of_metric, score, study};
use serde_json::json;
use taceva_report::{CompareRequest, Comparison, ScoreTable, Study, compare};
use taceva_results::Interval;

/// Two sensors; the second has the smaller errors.
fn two() -> [Study; 2] {
    [("Coarse", 0.75), ("Fine", 0.25)].map(|(sensor, value)| {
        let scores = [
            ("mae", "Fz", score(value, 0.01, "N")),
            ("rmse", "Fz", score(value, 0.01, "N")),
            ("shininess", "Fz", score(value, 0.01, "N")),
        ];
        study(sensor, &scores, &["Fz"])
    })
}

fn asked(comparison: &Comparison) -> Vec<String> {
    let decisions = comparison.decisions();
    decisions.iter().map(|decision| decision.asked()).collect()
}

#[test]
fn every_metric_that_is_asked_for_is_answered_beside_the_questions_with_a_name() {
    let request = CompareRequest {
        metrics: vec!["mae".to_owned(), "rmse".to_owned()],
        ..CompareRequest::default()
    };
    let comparison = compare(&two(), &request);
    assert_eq!(asked(&comparison), ["Normal force (mae Fz ↓)", "rmse Fz ↓"]);
    let overview = comparison.overview(None);
    let line = "\nrmse Fz ↓: Fine, 0.25 N, better than Coarse (p < 0.001)";
    assert!(overview.contains(line), "{overview}");
    // Without a request, only the named questions appear.
    let every = compare(&two(), &CompareRequest::default());
    assert_eq!(asked(&every), ["Normal force (mae Fz ↓)"]);
}

#[test]
fn markdown_has_the_answers_of_the_overview_above_every_pair() {
    let markdown = of_metric(&two(), "mae").markdown();
    let answer = "\n- Normal force (mae Fz ↓): Fine, 0.25 N, better than Coarse (p &lt; 0.001)";
    let [answer, table] = [answer, "\n| metric"].map(|part| markdown.find(part));
    assert!(
        answer.is_some() && answer < table,
        "{answer:?}, {table:?}: {markdown}"
    );
}

#[test]
fn a_metric_of_another_version_is_named_and_no_verdict_is_given_on_it() {
    let every = compare(&two(), &CompareRequest::default());
    let note =
        "shininess not compared: this version of TacEva does not know which values are better";
    assert!(
        every.notes.iter().any(|own| own == note),
        "{:?}",
        every.notes
    );
    assert!(
        every
            .answers
            .iter()
            .all(|answer| answer.metric != "shininess")
    );
    let decisions = of_metric(&two(), "shininess").decisions();
    assert_eq!(decisions[0].winner, None);
    assert_eq!(
        decisions[0].words,
        "no winner: this version of TacEva does not know which values are better"
    );
}

#[test]
fn a_group_means_its_metrics_that_have_scores_and_all_of_them_where_none_has() {
    let asked = |name: &str| CompareRequest {
        metrics: vec![name.to_owned()],
        ..CompareRequest::default()
    };
    let studies = two();
    let request = asked("accuracy").resolved(&studies).expect("a group");
    assert_eq!(request.metrics, ["mae", "r2"]);
    assert_eq!(request.absent(&studies), [""; 0]);
    let other = [study("A", &[("drift", "Fz", score(0.5, 0.01, "N"))], &[])];
    let request = asked("accuracy").resolved(&other).expect("a group");
    assert_eq!(request.metrics, ["mae", "r2", "smape"]);
    assert_eq!(
        request.absent(&other)[0],
        "mae: no result has this score, expected one of drift"
    );
    let request = asked("shininess").resolved(&studies).expect("a score");
    assert_eq!(request.metrics, ["shininess"]);
}

#[test]
fn a_margin_of_no_score_is_refused_with_the_scores_that_there_are() {
    let refused = |name: &str| {
        let request = CompareRequest {
            margins: [(name.to_owned(), 0.1)].into(),
            ..CompareRequest::default()
        };
        request.resolved(&two()).map_err(|error| error.to_string())
    };
    assert!(refused("mae").is_ok() && refused("mae.Fz").is_ok());
    let error = refused("mae.Fq").expect_err("no such channel");
    assert_eq!(
        error,
        "mae.Fq: no result has this score, expected mae or one of mae.Fz"
    );
    let error = refused("drift").expect_err("not scored");
    assert_eq!(
        error,
        "drift: no result has this score, expected one of mae, r2, rmse, shininess"
    );
    let error = refused("mea").expect_err("no metric");
    assert!(error.contains("did you mean `mae`?"), "{error}");
}

#[test]
fn a_note_on_skill_is_made_only_if_skill_is_asked_for() {
    let mut studies = ["one", "two"].map(|sensor| {
        let skill = ("skill", "Fz", score(0.9, 0.01, "1"));
        let error = ("mae", "Fz", score(0.25, 0.01, "N"));
        study(sensor, &[error, skill], &["Fz"])
    });
    for (study, seed) in studies.iter_mut().zip(["1", "2"]) {
        study.provenance.push(("seed".to_owned(), seed.to_owned()));
    }
    let has_note = |metrics: &[&str]| {
        let request = CompareRequest {
            metrics: metrics.iter().map(|name| (*name).to_owned()).collect(),
            ..CompareRequest::default()
        };
        let notes = compare(&studies, &request).notes;
        notes.iter().any(|note| note.starts_with("skill was"))
    };
    assert!(has_note(&[]) && has_note(&["mae", "skill"]));
    assert!(!has_note(&["mae"]));
}

#[test]
fn the_reason_why_no_score_has_an_interval_is_stated_once() {
    let without = |value: f64, unit: &str| {
        json!({
            "value": value, "unit": unit, "n": 80, "ci95": {"undefined": "samples without point_id"},
            "definition": "drawn/1"
        })
    };
    let studies = ["one", "two"].map(|sensor| {
        let scores = [
            ("mae", "Fz", without(0.25, "N")),
            ("r2", "Fz", without(0.9, "1")),
        ];
        study(sensor, &scores, &[])
    });
    let comparison = of_metric(&studies, "mae");
    let start = "no score of one and two has an interval, so no difference is tested: samples without point_id; ";
    let said = comparison.notes.iter();
    let said = said.filter(|note| note.starts_with(start));
    assert_eq!(said.count(), 1, "{:?}", comparison.notes);
    let reason = comparison.answers[0].reason.as_deref().unwrap_or_default();
    let own =
        "one: no interval to compare with predicting the mean: samples without point_id; two: ";
    assert!(reason.starts_with(own), "{reason}");
    let scores = ScoreTable::of(&studies);
    let text = scores.for_pages().text();
    assert_eq!(text.matches("no interval to compare").count(), 1, "{text}");
    assert_eq!(
        scores.title(),
        "Scores of 2 sensors on 80 simulated samples each, without intervals (samples without point_id)."
    );
    let published = studies.map(|study| Study {
        source: "published".to_owned(),
        ..study
    });
    let notes = of_metric(&published, "mae").notes;
    assert!(!notes.iter().any(|note| note.starts_with("no score of")));
}

#[test]
fn a_tested_score_without_an_interval_has_no_note_that_nothing_is_tested() {
    let mut studies =
        [("exact", 0.25), ("other", 0.5)].map(|(name, error)| sampled(name, 0.0, error));
    for score in &mut studies[0].scores {
        score.interval = Some(Interval::Absent("the score is at its end".to_owned()));
    }
    let comparison = of_metric(&studies, "mae");
    assert!(comparison.answers[0].difference.is_some());
    let mut notes = comparison.notes.iter();
    assert!(!notes.any(|note| note.starts_with("no score of")));
}
