//! Recordings of taxels alone, from the file to the score.

use std::num::NonZeroUsize;

use taceva_core::SilentProgress;
use taceva_dataset::Dataset;
use taceva_evaluate::{
    EvaluateError, EvaluateRequest, Evaluated, FitRequest, ModelChoice, Work, evaluate,
    evaluate_plan, fit, predict,
};
use taceva_models::{Model, ModelSettings};

use crate::taxel_drawing::{record, record_changed};

pub(crate) const WORK: Work<'_> = Work {
    jobs: NonZeroUsize::MIN,
    progress: &SilentProgress,
    cache: None,
};

pub(crate) fn request(model: &str, words: &[&str]) -> FitRequest {
    FitRequest {
        model: taceva_models::Models::builtin()
            .find(model)
            .expect("a model"),
        settings: ModelSettings::parse(words.iter().copied()).expect("pairs"),
        channels: Vec::new(),
        split: Some("chronological 80/0/20".to_owned()),
        seed: 0,
    }
}

pub(crate) fn evaluated(
    dataset: &Dataset,
    model: &str,
    words: &[&str],
) -> Result<Evaluated, EvaluateError> {
    evaluate(dataset, &of(ModelChoice::Fit(request(model, words))), WORK)
}

pub(crate) fn of(model: ModelChoice) -> EvaluateRequest {
    EvaluateRequest {
        model,
        metrics: vec!["r2".to_owned()],
        part: None,
        sensor: None,
        is_independent: false,
    }
}

pub(crate) fn r2(evaluated: &Evaluated) -> f64 {
    r2_of(evaluated, "Fz")
}

pub(crate) fn r2_of(evaluated: &Evaluated, channel: &str) -> f64 {
    let score = evaluated.report.score("r2", channel);
    score.expect("scored").value.number().expect("defined")
}

#[test]
fn ridge_scores_what_scikit_learn_scores() {
    // Printed by `reference.py` with NumPy 2.4.6 and scikit-learn 1.9.1.
    let expected = [
        ("strength=0.001", 0.9998311731512206),
        ("strength=1", 0.9955851548394434),
    ];
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), 10_800);
    for (word, expected) in expected {
        let found = r2(&evaluated(&dataset, "ridge", &[word]).expect("evaluated"));
        assert!(
            (found - expected).abs() < 1e-9,
            "{word}: {found} for {expected}"
        );
        // Subtracting the signals at rest does not change the result.
        let found = evaluated(&dataset, "ridge", &[word, "difference=true"]).expect("evaluated");
        assert!(
            (r2(&found) - expected).abs() < 1e-6,
            "{word}: {} for {expected}",
            r2(&found)
        );
    }
    let size = std::fs::metadata(dataset.path().join("signals.parquet"))
        .expect("there")
        .len();
    assert!(size < 2_000_000, "{size} bytes");
}

#[test]
fn every_model_but_networks_takes_signals_as_they_are_and_keeps_them_in_its_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), 300);
    let models = [
        ("baseline", -1.0),
        ("ridge", 0.99),
        ("pls", 0.99),
        ("elastic-net", 0.99),
        ("kernel-ridge", 0.9),
        ("gaussian-process", 0.9),
        ("knn", 0.9),
        ("random-forest", 0.9),
        ("gradient-boosting", 0.9),
        ("auto", 0.99),
    ];
    for (name, least) in models {
        let fitted = fit(&dataset, &request(name, &[]), None, WORK).expect(name);
        let model = fitted.model;
        let card = model.card();
        assert_eq!(
            card.features.to_string(),
            "signals of 5×1 places of 3",
            "{name}"
        );
        assert_eq!(card.spread.as_ref().map(Vec::len), Some(3), "{name}");
        let again = Model::from_bytes(&model.to_bytes().expect("small")).expect("reads");
        assert!(
            again.to_bytes().expect("small") == model.to_bytes().expect("small"),
            "{name}"
        );
        let found = evaluate(&dataset, &of(ModelChoice::Fitted(Box::new(again))), WORK);
        let found = found.expect(name);
        assert!(r2(&found) > least, "{name}: {}", r2(&found));
        assert_eq!(found.report.provenance.frames_decoded, 0, "{name}");
    }
}

#[test]
fn a_model_of_signals_says_what_it_is_of_and_refuses_other_grids() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), 100);
    let model = fit(&dataset, &request("ridge", &[]), None, WORK)
        .expect("fitted")
        .model;
    let bytes = model.to_bytes().expect("small");
    let text = String::from_utf8_lossy(&bytes);
    assert!(
        text.contains(r#"\"signals\":{\"rows\":5,\"columns\":1,\"channels\":3,\"unit\":\"uT\"}"#),
        "{text}"
    );
    // Force drives all three axes. The signals of each are divided by the power of two nearest to their spread, some tens of µT.
    let spread = model.card().spread.clone().expect("of signals");
    assert!(
        spread
            .iter()
            .all(|spread| [16.0, 32.0, 64.0].contains(spread)),
        "{spread:?}"
    );
    let other = another_grid(&folder.path().join("other"));
    let error = predict(&other, &model, None, WORK)
        .expect_err("another grid")
        .to_string();
    assert!(
        error.contains(
            "signals of 1×2 places of 1 in count, expected signals of 5×1 places of 3 in uT"
        ),
        "{error}"
    );
}

#[test]
fn what_is_of_frames_alone_is_refused_in_words() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record(&folder.path().join("data"), 100);
    let refused = |words: &[&str]| {
        let error = evaluated(&dataset, "ridge", words).expect_err("refused");
        error.to_string()
    };
    for word in [
        "size=8",
        "size=auto",
        "color=rgb",
        "features=markers",
        "input=frame",
    ] {
        let message = refused(&[word]);
        assert_eq!(
            message,
            format!("`{word}` applies to frames, but the recording has only signals")
        );
    }
    for words in [
        ["features=pixels", "input=signals"],
        ["features=signals", "input=frame"],
    ] {
        assert!(refused(&words).contains("features="), "{words:?}");
    }
    for words in [
        &["features=signals"][..],
        &["input=signals"],
        &["pca=3", "difference=auto"],
    ] {
        assert!(evaluated(&dataset, "ridge", words).is_ok(), "{words:?}");
    }
    let plan = evaluate_plan(&dataset, &of(ModelChoice::Fit(request("ridge", &[])))).expect("plan");
    let steps: Vec<&str> = plan.steps.iter().map(|step| step.what.as_str()).collect();
    assert!(
        steps.contains(&"signals of 5×1 places of 3 of 80 samples"),
        "{steps:?}"
    );
}

#[test]
fn a_signal_that_never_changes_harms_no_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let dataset = record_changed(&folder.path().join("data"), 200, |_, mut values| {
        values.iter_mut().step_by(3).for_each(|value| *value = 7.0);
        values
    });
    let found = evaluated(&dataset, "ridge", &[]).expect("evaluated");
    assert!(r2(&found) > 0.99);
}

/// A recording with another grid of taxels: two signals in counts.
fn another_grid(path: &std::path::Path) -> Dataset {
    use taceva_core::{Channel, Channels, Clock, Readings, Sample, SignalInfo, Signals, Unit};
    use taceva_dataset::{
        Recorder, RecordingFacts, RecordingSpec, SensorFacts, SignalsSpec, Source,
    };
    let info = SignalInfo::new(1, 2, 1, Unit::Count).expect("two");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, SensorFacts::new("drawn"));
    let spec = RecordingSpec::new(facts, Channels::new([Channel::FZ]).expect("one"))
        .with_signals(SignalsSpec::new(info, ["pressure"]).expect("one name"));
    let mut recorder = Recorder::create(path, &spec).expect("new");
    let sample = Sample::new("press").with_truth(Readings::from_values([0.5]));
    let signals = Signals::new(info, vec![1.0, 2.0]).expect("finite");
    recorder
        .append(&sample.with_signals(signals))
        .expect("recorded");
    recorder.close().expect("closed");
    Dataset::open(path).expect("a dataset")
}
