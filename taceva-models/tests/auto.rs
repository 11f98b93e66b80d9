//! Tests of `auto`: the choice depends on errors and work, and reads no clock.

use taceva_core::{Features, SilentProgress};
use taceva_models::{
    AutoCard, CloserFeatures, FeatureSpec, FitInput, Model, ModelSettings, Provenance,
    SettingError, find,
};

use crate::blobs::{FRAME, Recording, SHAPE, numbers};

/// Blobs darker or brighter, equally often, than a much stronger slope of light. Models that are linear in pixels or compare whole pictures
/// cannot find their positions.
#[expect(
    clippy::cast_possible_truncation,
    reason = "features are kept in single precision"
)]
fn hidden(samples: usize, seed: u64) -> Recording {
    let mut next = numbers(seed);
    let mut values = Vec::new();
    let mut labels = Vec::new();
    for _ in 0..samples {
        let (y, x) = (4.0 + 12.0 * next(), 4.0 + 16.0 * next());
        let amplitude = if next() < 0.5 { 1.0 } else { -1.0 };
        let slopes = [0.5 * next() - 0.25, 0.5 * next() - 0.25];
        for row in 0..20_u8 {
            for column in 0..24_u8 {
                let (row, column) = (f64::from(row), f64::from(column));
                let square = (row - y).powi(2) + (column - x).powi(2);
                let light = slopes[0] * row + slopes[1] * column;
                values.push((light + amplitude * (-square / 10.0).exp() + 0.02 * next()) as f32);
            }
        }
        labels.extend([x, y]);
    }
    let features = Features::new(SHAPE, values).expect("whole samples");
    Recording {
        features,
        labels,
        ..crate::blobs::recording(2, 1)
    }
}

fn spec() -> FeatureSpec {
    FeatureSpec {
        width: 24,
        height: 20,
        ..FeatureSpec::DEFAULT
    }
}

fn fit(name: &str, words: &[&str], of: &Recording, closer: Option<CloserFeatures<'_>>) -> Model {
    let settings = ModelSettings::parse(words.iter().copied()).expect("pairs");
    let estimator = find(name).expect("registered").estimator(&settings);
    let estimator = estimator.expect("valid");
    let input = FitInput {
        estimator: &*estimator,
        settings: &settings,
        features: spec(),
        input: FRAME.into(),
        training: of.set(),
        validation: None,
        provenance: Provenance::default(),
    };
    match closer {
        None => Model::fit(input, &SilentProgress),
        Some(closer) => Model::fit_closer(input, closer, &SilentProgress),
    }
    .expect("fitted")
}

fn card(model: &Model) -> &AutoCard {
    model.card().auto.as_ref().expect("chosen")
}

/// Reason for not trying a model.
fn reason<'m>(model: &'m Model, name: &str) -> &'m str {
    let mut untried = card(model).untried.iter();
    let found = untried.find(|untried| untried.model == name);
    &found
        .unwrap_or_else(|| panic!("{name}: {}", card(model)))
        .reason
}

#[test]
fn what_a_network_alone_sees_is_given_to_the_network_after_one_look() {
    let recording = hidden(240, 1);
    let model = fit("auto", &[], &recording, None);
    let card = card(&model);
    assert_eq!(card.taken, "cnn", "{card}");
    let best = card.best().expect("tried");
    assert_eq!((best.folds, best.share), (1, Some(0.25)), "{card}");
    let ridge = card.tried.iter().find(|trial| trial.model == "ridge");
    assert!(ridge.expect("tried").error > 1.5 * best.error, "{card}");
    let said = reason(&model, "random-forest");
    assert_eq!(said, "cnn is clearly ahead of all cheaper models");
    assert!(reason(&model, "resnet18").contains("name this model to fit it"));
    // Settings of the preset `default`.
    let alone = fit("cnn", &["appearance=auto"], &recording, None);
    assert_eq!(model.regressor(), alone.regressor());
    assert_eq!(model.card().model, "cnn");
}

#[test]
fn where_nothing_is_learnable_the_simplest_is_taken() {
    // Each picture has the labels of another picture.
    let recording = hidden(100, 2);
    let others: Vec<usize> = (0..100).map(|row| (37 * row + 11) % 100).collect();
    let recording = Recording {
        features: recording.select(&others).features,
        ..recording
    };
    let model = fit("auto", &[], &recording, None);
    let taken = card(&model).taken.as_str();
    assert!(matches!(taken, "baseline" | "ridge"), "{}", card(&model));
    let network = card(&model)
        .tried
        .iter()
        .rfind(|trial| trial.model == "cnn");
    let left = network.expect("tried").left.as_deref().expect("said");
    assert!(
        left.contains("baseline") || left.contains("ridge"),
        "{left}"
    );
}

#[test]
fn a_network_that_is_beyond_the_budget_is_named_with_what_it_takes() {
    let recording = hidden(240, 1);
    let model = fit("auto", &["budget_s=0.5"], &recording, None);
    let said = reason(&model, "cnn");
    let (takes, left) = said
        .strip_prefix("beyond the budget: trying and fitting it takes ")
        .and_then(|rest| rest.split_once(" s of work, "))
        .unwrap_or_else(|| panic!("{said}"));
    assert!(takes.parse::<f64>().expect("a number") > 0.5, "{said}");
    assert!(left.ends_with(" of budget_s=0.5 are left"), "{said}");
    assert_ne!(card(&model).taken, "cnn");
    let spent: f64 = card(&model).tried.iter().map(|trial| trial.cost_s).sum();
    assert!(spent <= 0.5, "{spent}");
}

#[test]
fn models_that_are_clearly_beaten_are_not_tried_again() {
    // Blobs on an even background, which most models can find.
    let model = fit(
        "auto",
        &["budget_s=0.5"],
        &crate::blobs::recording(120, 5),
        None,
    );
    let card = card(&model);
    let left = card.tried.iter().filter(|trial| trial.folds == 1);
    let left: Vec<&str> = left.filter_map(|trial| trial.left.as_deref()).collect();
    assert!(
        left.iter().any(|left| left.ends_with(" is clearly ahead")),
        "{card}"
    );
    let best = card.best().expect("tried");
    assert!(best.error < 0.3, "{card}");
    let same = |other: &&taceva_models::AutoTrial| other.folds == best.folds;
    let least = card.tried.iter().filter(same).map(|trial| trial.error);
    assert!(least.fold(f64::INFINITY, f64::min) >= best.error, "{card}");
}

#[test]
fn networks_see_finer_features_where_there_are_such_and_others_do_not() {
    let coarse = crate::blobs::recording(240, 6);
    let finer = hidden(240, 1);
    // Nothing can be learnt from the coarse features: the labels belong to the finer ones.
    let coarse = Recording {
        labels: finer.labels.clone(),
        ..coarse
    };
    let closer = CloserFeatures {
        spec: FeatureSpec {
            difference: true,
            ..spec()
        },
        training: &finer.features,
        validation: None,
    };
    let model = fit("auto", &[], &coarse, Some(closer));
    assert_eq!(model.card().model, "cnn", "{}", card(&model));
    assert_eq!(model.card().features, closer.spec);
    let alone = fit("cnn", &["appearance=auto"], &finer, None);
    assert_eq!(model.regressor(), alone.regressor());
    let plain = fit("auto", &["budget_s=0"], &coarse, Some(closer));
    assert_eq!(plain.card().features, spec());
}

#[test]
fn a_budget_that_is_no_number_of_seconds_and_a_misspelt_one_are_refused() {
    let refused = |word: &str| {
        let settings = ModelSettings::parse([word]).expect("a pair");
        let estimator = find("auto").expect("registered").estimator(&settings);
        estimator.map(drop).expect_err(word)
    };
    for word in [
        "budget_s=-1",
        "budget_s=NaN",
        "budget_s=soon",
        "budget_s=1e7",
    ] {
        let error = refused(word);
        assert!(matches!(error, SettingError::Value { .. }), "{error:?}");
        assert_eq!(
            error.to_string(),
            format!("`{word}`: expected a number from 0 to 1e6")
        );
    }
    assert_eq!(
        refused("budget=60").to_string(),
        "`budget`: unknown key, did you mean `budget_s`?"
    );
}
