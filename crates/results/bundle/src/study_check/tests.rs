//! Tests of verdicts after a prediction by the model and after a repeated fit.

use taceva_results::{Interval, Value};

use super::*;
use crate::claim::claims;

/// A study with one score, 0.1 N, and its interval.
fn report() -> EvaluationReport {
    let result = r#"{"schema": "taceva.evaluation/1.0", "subject": {"sensor": "drawn", "source": "simulated"}, "metrics": {"mae": {"Fz": {"value": 0.1, "unit": "N", "n": 24, "definition": "mae/1"}}}}"#;
    let sealed = taceva_files::seal::json::seal(result).expect("JSON");
    let mut report = taceva_results::read(&sealed).expect("results").remove(0);
    report.scores[0].interval = Some(Interval::Ends {
        ends: [0.05, 0.2],
        method: String::new(),
        standard_error: None,
        clusters: None,
        degrees_of_freedom: None,
    });
    report
}

/// Level and verdict of the claim of [`report`], which states and tables reproduce.
fn verdict(model: Result<PredictionCheck, Stop>, fit: Result<FitScores, Stop>) -> (Level, Verdict) {
    let report = report();
    let tables = TableScores {
        scores: report.scores.clone(),
        has_other_sums: false,
        left_out: Vec::new(),
    };
    let check = StudyCheck {
        study: 0,
        report: &report,
        again: Recomputation {
            states: Ok(report.clone()),
            tables: Ok(tables),
            model,
            fit,
        },
        most: Level::Fit,
        tolerance: 0.0,
    };
    let claims = claims(0, &report, &[]);
    let found = check.claim(&claims[0]);
    (found.level, found.verdict)
}

fn stop(is_absent: bool) -> Stop {
    Stop {
        reason: "no recording".to_owned(),
        is_absent,
    }
}

#[test]
fn predictions_near_those_of_the_model_are_within_and_others_differ() {
    let near = PredictionCheck::Near {
        share: 1e-7,
        first: "Fz in line 2".to_owned(),
    };
    let absent = || Err(stop(true));
    assert_eq!(verdict(Ok(near), absent()), (Level::Model, Verdict::Within));
    let differs = PredictionCheck::Differs("Fz in line 2".to_owned());
    let expected = (Level::Model, Verdict::Differs);
    assert_eq!(verdict(Ok(differs), absent()), expected);
    let (level, of_absent) = verdict(Err(stop(true)), absent());
    assert_eq!((level, of_absent), (Level::Predictions, Verdict::Equal));
    let refused = verdict(Err(stop(false)), absent());
    assert_eq!(refused, (Level::Predictions, Verdict::NotRecomputable));
}

#[test]
fn another_model_of_a_repeated_fit_is_within_if_its_score_lies_in_the_interval() {
    let equal = || Ok(PredictionCheck::Equal { samples: 24 });
    let other = |value: f64| {
        let mut scores = report().scores;
        scores[0].value = Value::Number(value);
        Ok(FitScores::Other(scores))
    };
    assert_eq!(
        verdict(equal(), Ok(FitScores::Equal)),
        (Level::Fit, Verdict::Equal)
    );
    assert_eq!(verdict(equal(), other(0.19)), (Level::Fit, Verdict::Within));
    assert_eq!(
        verdict(equal(), other(0.21)),
        (Level::Fit, Verdict::Differs)
    );
}
