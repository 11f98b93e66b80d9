//! Tests of reports about real recordings, as far as their labels allow. Skipped, with a printed reason, if a data set is absent.

use std::num::NonZeroUsize;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateRequest, FitRequest, ModelChoice, Work, evaluate};
use taceva_import::{ImportMap, ImportPlan};
use taceva_models::ModelSettings;
use taceva_report::catalogue::Sensor;
use taceva_report::{CompareRequest, Need, ReportPage, Study, choose, compare, figures, report};
use taceva_results::Samples;
use taceva_tests::{recording, root};

const WORK: Work<'_> = Work {
    jobs: NonZeroUsize::new(2).expect("two"),
    progress: &SilentProgress,
    cache: None,
};

/// Evaluates `model` on the data set `name`. Returns the scores with the samples; `None` if the data set is absent.
fn study(name: &str, model: &str, split: &str) -> Option<Study> {
    let source = recording(name)?;
    let map = root()
        .join("tests/fixtures/maps")
        .join(name)
        .with_extension("toml");
    let map = ImportMap::read(&map).expect("the map is ours");
    let target = tempfile::tempdir().expect("a temporary folder");
    let path = target.path().join("data");
    let plan = ImportPlan::new(&source, &map).expect("the map fits the set");
    plan.run(&path, WORK.jobs, &SilentProgress)
        .expect("imported");
    let dataset = Dataset::open(&path).expect("a dataset");
    let request = EvaluateRequest {
        model: ModelChoice::Fit(FitRequest {
            model: taceva_models::find(model).expect("a model").into(),
            settings: ModelSettings::default(),
            channels: Vec::new(),
            split: Some(split.to_owned()),
            seed: 0,
        }),
        metrics: vec!["all".to_owned()],
        part: None,
        is_independent: false,
        sensor: None,
    };
    let written = evaluate(&dataset, &request, WORK)
        .expect("evaluated")
        .report;
    let text = taceva_results::sealed(&written).expect("an object");
    let mut study = Study::read(&text).expect("what we write we read").remove(0);
    let mut table = Vec::new();
    let samples = written.samples.expect("the samples of one call");
    samples.write(&mut table).expect("memory");
    let table = String::from_utf8(table).expect("a text");
    study.samples = Some(Samples::read(&table).expect("what we write we read"));
    Some(study)
}

#[test]
fn two_models_on_one_recording_are_compared_sample_by_sample() {
    let [Some(ridge), Some(neighbours)] =
        ["ridge", "knn"].map(|model| study("tactip-force", model, "chronological"))
    else {
        return;
    };
    let comparison = compare(&[ridge, neighbours], &CompareRequest::default());
    let answer = comparison
        .answers
        .iter()
        .find(|answer| answer.metric == "mae" && answer.channel == "Fx")
        .expect("both have it");
    let difference = answer.difference.as_ref().expect("tested");
    assert!(difference.test.to_string().starts_with("paired sign flip"));
    assert_eq!(
        answer.better(),
        Some(0),
        "{}",
        answer.words(&comparison.names)
    );
}

#[test]
fn a_model_that_answers_the_same_whatever_it_sees_wins_and_loses_nothing() {
    let [Some(ridge), Some(baseline)] =
        ["ridge", "baseline"].map(|model| study("tactip-force", model, "chronological"))
    else {
        return;
    };
    let comparison = compare(&[ridge, baseline], &CompareRequest::default());
    let predicted = ["mae", "rmse", "r2", "smape"];
    let mut seen = 0;
    for answer in &comparison.answers {
        if !predicted.contains(&answer.metric.as_str()) {
            continue;
        }
        seen += 1;
        assert_eq!(answer.better(), None, "{}", answer.words(&comparison.names));
        assert!(
            answer
                .words(&comparison.names)
                .contains("not better than predicting the mean")
        );
    }
    assert!(seen > 0, "nothing was compared");
}

#[test]
fn two_sensors_of_two_labs_are_shown_compared_and_chosen_from() {
    let split = "by-column:repeat=train:1;test:2";
    let studies = [
        study("tactip-force", "ridge", "chronological"),
        study("gelsight-wedge-grasp", "ridge", split),
    ];
    let Some(studies) = studies.into_iter().collect::<Option<Vec<Study>>>() else {
        return;
    };
    let comparison = compare(&studies, &CompareRequest::default());
    let answer = comparison
        .answers
        .iter()
        .find(|answer| answer.metric == "mae" && answer.channel == "Fz")
        .expect("both have it");
    let is_answered = answer.difference.is_some() || answer.reason.is_some();
    assert!(is_answered, "{answer:?}");
    let drawn: Vec<String> = figures(&studies)
        .into_iter()
        .map(|figure| figure.id)
        .collect();
    for id in ["labels", "predicted-1", "predicted-2"] {
        assert!(drawn.iter().any(|drawn| drawn == id), "{id}: {drawn:?}");
    }
    let page = report(&ReportPage {
        title: "two labs",
        studies: &studies,
        pictures: &[],
        triples: &[],
    });
    assert!(page.contains("recorded") && !page.contains("Nothing here was measured"));
    let sensors: Vec<Sensor> = studies.iter().map(Sensor::of_study).collect();
    let choice = choose(&sensors, &Need::parse("normal force").expect("a need"));
    assert_eq!(choice.ranked.len(), 2, "{choice:?}");
    let errors = sensors
        .iter()
        .map(|sensor| sensor.result("mae", "Fz").expect("scored").value);
    let least = errors.fold(f64::INFINITY, f64::min);
    let first = choice.ranked[0].steps[0].value.expect("known");
    assert_eq!(first.to_bits(), least.to_bits());
}
