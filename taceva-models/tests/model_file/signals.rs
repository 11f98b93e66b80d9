//! Models of signals on disk, and rejected cards of them.

use taceva_core::{
    Channel, Channels, Features, Regressor, SignalInfo, Signals, SilentProgress, Targets,
    TrainingSet, Unit,
};
use taceva_models::{
    Extractor, FeatureError, FeatureSpec, FitInput, FormatError, Model, ModelSettings, Provenance,
    find,
};

use super::refused::with_card;
use super::{SPEC, fit};

fn grid() -> SignalInfo {
    SignalInfo::new(3, 2, 2, Unit::Count).expect("twelve numbers")
}

/// Thirty samples of twelve counts, which increase and decrease with the force.
fn signals() -> Vec<Signals> {
    let sample = |force: u16| {
        let values = (0..12_u16).map(|place| {
            let noise = f32::from((force * 7 + place * 3) % 5);
            500.0 + f32::from(force) * (f32::from(place) - 5.5) + noise
        });
        Signals::new(grid(), values.collect()).expect("finite")
    };
    (0..30).map(sample).collect()
}

fn of_signals(words: &[&str]) -> (Model, Features) {
    let settings = ModelSettings::parse(words.iter().copied()).expect("pairs");
    let (of_features, of_model) = settings.partition(FeatureSpec::SETTINGS);
    let spec = FeatureSpec::DEFAULT
        .changed_by(&of_features)
        .expect("valid");
    let spec = spec.on(&of_features, None, Some(grid())).expect("signals");
    let samples = signals();
    let rest = samples.first().map(Into::into);
    let extractor = Extractor::new(spec, grid(), rest).expect("fits");
    let features = extractor.extract_all(&samples).expect("one grid");
    let channels = Channels::new([Channel::FZ]).expect("one");
    let forces: Vec<f64> = (0..30_u8).map(f64::from).collect();
    let estimator = find("ridge")
        .expect("there")
        .estimator(&of_model)
        .expect("valid");
    let input = FitInput {
        estimator: &*estimator,
        settings: &of_model,
        features: spec,
        input: grid().into(),
        training: TrainingSet::new(&features, Targets::new(&channels, &forces)),
        validation: None,
        provenance: Provenance::default(),
    };
    (
        Model::fit(input, &SilentProgress).expect("learnable"),
        features,
    )
}

#[test]
fn a_model_of_signals_comes_back_and_predicts_the_same_bits() {
    for words in [&[][..], &["difference=true"], &["pca=2"], &["scale=none"]] {
        let (model, features) = of_signals(words);
        let again = Model::from_bytes(&model.to_bytes().expect("small")).expect("reads");
        assert_eq!(again, model, "{words:?}");
        let found = again.predict(&features).expect("finite");
        assert_eq!(found, model.predict(&features).expect("finite"));
        for (force, found) in (0..30_u8).zip(found) {
            assert!(
                (found - f64::from(force)).abs() < 0.5,
                "{words:?}: {found} for {force}"
            );
        }
        let flat = Features::new(taceva_core::FeatureShape::flat(12), vec![0.0; 12]);
        assert!(model.predict(&flat.expect("one sample")).is_err());
    }
}

#[test]
fn a_model_that_scales_features_itself_predicts_the_same_bits_without_the_division() {
    let (model, features) = of_signals(&[]);
    assert!(
        model
            .card()
            .spread
            .iter()
            .flatten()
            .all(|spread| *spread > 1.0)
    );
    let channels = Channels::new([Channel::FZ]).expect("one");
    let forces: Vec<f64> = (0..30_u8).map(f64::from).collect();
    let training = TrainingSet::new(&features, Targets::new(&channels, &forces));
    let settings = ModelSettings::default();
    let estimator = find("ridge")
        .expect("there")
        .estimator(&settings)
        .expect("valid");
    let plain = estimator
        .fit_model(&training, None, &SilentProgress)
        .expect("learnable");
    let mut expected = vec![0.0; 30];
    plain
        .regressor
        .predict(&features, &mut expected)
        .expect("finite");
    let found = model.predict_unbounded(&features).expect("finite");
    let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(found), bits(expected));
}

#[test]
fn a_card_that_is_of_two_inputs_or_none_is_refused() {
    let (model, _) = of_signals(&[]);
    let bytes = model.to_bytes().expect("small");
    let changes: [fn(&mut serde_json::Value); 7] = [
        |card| card["spread"] = serde_json::json!([8.0]),
        |card| card["spread"] = serde_json::json!([8.0, 0.0]),
        |card| card["spread"] = serde_json::Value::Null,
        |card| card["signals"]["rows"] = 6.into(),
        |card| card["signals"]["channels"] = 1.into(),
        |card| card["features"]["channels"] = 3.into(),
        |card| {
            let frame = serde_json::json!({"width": 3, "height": 2, "format": "gray8"});
            let card = card.as_object_mut().expect("an object");
            card.remove("signals");
            card.insert("frame".to_owned(), frame);
        },
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let read = Model::from_bytes(&with_card(&bytes, change));
        assert!(matches!(read, Err(FormatError::Card)), "{number}: {read:?}");
    }
    let unchanged = Model::from_bytes(&with_card(&bytes, |_| {}));
    assert_eq!(unchanged.expect("reads"), model);
    let neither = with_card(&bytes, |card| {
        card.as_object_mut().expect("an object").remove("signals");
    });
    assert!(Model::from_bytes(&neither).is_err());
}

#[test]
fn a_model_of_frames_is_written_as_before_there_were_signals() {
    let (model, _) = fit("ridge", &[], SPEC);
    let bytes = model.to_bytes().expect("small");
    let text = String::from_utf8_lossy(&bytes).replace('\\', "");
    let expected =
        r#""pca_variance":null,"frame":{"width":20,"height":15,"format":"rgb8"},"margin":0.25"#;
    assert!(text.contains(expected), "{text}");
    assert!(!text.contains("spread") && !text.contains("signals"));
}

#[test]
fn frames_and_signals_are_not_taken_for_each_other() {
    let (of_taxels, _) = of_signals(&[]);
    let (of_frames, _) = fit("ridge", &[], SPEC);
    let error = of_frames.extractor(grid(), None).expect_err("signals");
    assert!(matches!(error, FeatureError::Input { .. }), "{error}");
    assert_eq!(
        error.to_string(),
        "signals of 3×2 places of 2 in count, expected a frame of 20×15 rgb8"
    );
    assert!(of_taxels.extractor(super::FRAME, None).is_err());
    let wide = SignalInfo::new(2, 3, 2, Unit::Count).expect("twelve numbers");
    assert!(of_taxels.extractor(wide, None).is_err());
    let settings = ModelSettings::default();
    let both = FeatureSpec::DEFAULT.on(&settings, Some(super::FRAME), Some(grid()));
    assert_eq!(both, Err(FeatureError::TwoInputs));
    let frame = ModelSettings::parse(["input=frame"]).expect("a pair");
    let frame = FeatureSpec::DEFAULT.on(&frame, Some(super::FRAME), Some(grid()));
    assert_eq!(frame, Ok(FeatureSpec::DEFAULT));
    let signals = ModelSettings::parse(["input=signals"]).expect("a pair");
    let none = FeatureSpec::DEFAULT.on(&signals, Some(super::FRAME), None);
    assert_eq!(none, Err(FeatureError::NoSignals));
}
