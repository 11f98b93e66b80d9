//! Contents that survive writing and reading a model.

use taceva_core::{FeatureShape, Features, FrameInfo, Unit};
use taceva_models::{FeatureError, FeatureKind, FeatureSpec, Model, NetworkCard, NetworkRegressor};
use taceva_network::ConvolutionForm;

use super::refused::with_card;
use super::{FRAME, SPEC, fit};

#[test]
fn a_saved_model_comes_back_with_the_same_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, words) in [
        ("baseline", &[][..]),
        ("ridge", &["refit=false"]),
        ("pls", &["most=7"]),
    ] {
        let (model, features) = fit(name, words, SPEC);
        let path = folder.path().join(format!("{name}.safetensors"));
        model.save(&path).expect("written");
        let again = Model::open(&path).expect("read");
        assert_eq!(again, model);
        let bits = |model: &Model| -> Vec<u64> {
            let found = model.predict(&features).expect("finite");
            found.into_iter().map(f64::to_bits).collect()
        };
        assert_eq!(bits(&again), bits(&model));
        assert_eq!(
            again.to_bytes().expect("small"),
            std::fs::read(&path).expect("read")
        );
        assert_eq!(
            again.digest().expect("small"),
            model.digest().expect("small")
        );
        assert_eq!(model.card().settings, words);
    }
    let names: Vec<_> = std::fs::read_dir(folder.path())
        .expect("a folder")
        .collect();
    assert_eq!(
        names.len(),
        3,
        "nothing but the models is left in the folder"
    );
}

#[test]
fn a_network_predicts_in_the_form_that_its_card_says() {
    fn card(model: &Model) -> &NetworkCard {
        let network = model.regressor().get::<NetworkRegressor>();
        network.expect("a network").card()
    }
    // Large enough for several tiles.
    let spec = FeatureSpec {
        width: 20,
        height: 15,
        ..SPEC
    };
    let (model, features) = fit("resnet10", &["epochs=1", "batch=20"], spec);
    let words = ["epochs=1", "batch=20", "convolutions=direct"];
    let (direct, _) = fit("resnet10", &words, spec);
    assert_eq!(card(&model).convolutions, ConvolutionForm::Winograd);
    assert_eq!(card(&direct).convolutions, ConvolutionForm::Direct);
    let other = with_card(&model.to_bytes().expect("small"), |card| {
        card["network"]["convolutions"] = "direct".into();
    });
    let other = Model::from_bytes(&other).expect("another form");
    let predicted = |model: &Model| model.predict(&features).expect("finite");
    let bits =
        |model: &Model| -> Vec<u64> { predicted(model).into_iter().map(f64::to_bits).collect() };
    // The training is the same.
    assert!(bits(&other) == bits(&direct));
    assert!(bits(&model) != bits(&direct));
    for (one, other) in predicted(&model).into_iter().zip(predicted(&direct)) {
        assert!((one - other).abs() < 1e-4, "{one}, {other}");
    }
}

#[test]
fn fitting_again_gives_the_same_bytes() {
    let bytes = || fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    assert_eq!(bytes(), bytes());
}

#[test]
fn the_card_says_what_the_model_is() {
    let (model, _) = fit("ridge", &[], SPEC);
    let card = model.card();
    assert_eq!((card.samples.train, card.samples.validation), (40, 20));
    assert_eq!(
        (card.channels[0].name.as_str(), card.channels[0].unit),
        ("Fz", Unit::Newton)
    );
    assert!(card.refitted);
    assert!(
        card.choice
            .channels
            .iter()
            .all(|choice| choice.rmse.is_some_and(|rmse| rmse < 0.05))
    );
    assert!(model.digest().expect("small").starts_with("sha256:"));
}

#[test]
fn weights_of_pixels_equal_weights_of_principal_components() {
    let components = FeatureSpec {
        pca: Some(20),
        ..SPEC
    };
    let (model, features) = fit(
        "pls",
        &["components=20", "scale=none", "refit=false"],
        components,
    );
    let (plain, _) = fit("pls", &["components=20", "scale=none", "refit=false"], SPEC);
    // All twenty components are a rotation, which does not change least squares. Coordinates are rounded to f32.
    for (found, expected) in model
        .predict(&features)
        .expect("finite")
        .iter()
        .zip(plain.predict(&features).expect("finite"))
    {
        assert!((found - expected).abs() < 1e-5, "{found} for {expected}");
    }
    assert!(
        model
            .card()
            .pca_variance
            .is_some_and(|share| (share - 1.0).abs() < 1e-9)
    );
}

#[test]
fn a_model_of_statistics_says_so_and_one_of_pixels_says_nothing() {
    let of_statistics = FeatureSpec {
        kinds: FeatureKind::Statistics.into(),
        ..SPEC
    };
    let (model, features) = fit("ridge", &[], of_statistics);
    let opened = Model::from_bytes(&model.to_bytes().expect("small")).expect("opens");
    assert_eq!(opened.card().features, of_statistics);
    let predictions = [&opened, &model].map(|model| model.predict(&features).expect("finite"));
    assert_eq!(predictions[0], predictions[1]);
    let (pixels, _) = fit("ridge", &[], SPEC);
    let bytes = pixels.to_bytes().expect("small");
    let text = String::from_utf8_lossy(&bytes);
    assert!(!text.contains("kinds"));
}

#[test]
fn frames_of_another_kind_are_refused() {
    let (model, _) = fit("ridge", &[], SPEC);
    assert!(model.extractor(FRAME, None).is_ok());
    let other = FrameInfo { width: 21, ..FRAME };
    let error = model.extractor(other, None).expect_err("another width");
    assert!(matches!(error, FeatureError::Kind { .. }));
    assert_eq!(
        error.to_string(),
        "a frame of 21×15 rgb8, expected 20×15 rgb8"
    );
}

#[test]
fn features_other_than_asked_for_are_refused() {
    let (model, _) = fit("ridge", &[], SPEC);
    let other = Features::new(FeatureShape::flat(20), vec![0.0; 20]).expect("whole");
    assert!(model.predict(&other).is_err());
}
