//! Models on disk: the same model comes back, and nothing else is taken for one.

use std::path::Path;

use taceva_core::{
    Channel, Channels, FeatureShape, Features, Frame, FrameInfo, PixelFormat, SilentProgress,
    Targets, TrainingSet, Unit,
};
use taceva_models::{
    Color, FeatureError, FeatureKind, FeatureSpec, FitInput, FormatError, Model, ModelFileError,
    ModelRegressor, Provenance, Settings, Source, SplitCard, find,
};

const FRAME: FrameInfo = FrameInfo {
    width: 20,
    height: 15,
    format: PixelFormat::Rgb8,
};

const SPEC: FeatureSpec = FeatureSpec {
    width: 5,
    height: 4,
    color: Color::Gray,
    difference: false,
    pca: None,
    ..FeatureSpec::DEFAULT
};

/// Frames whose brightness patterns carry the labels.
fn frames(count: usize) -> Vec<Frame> {
    let mut state = 1_u64;
    let mut byte = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        state.to_be_bytes()[0]
    };
    (0..count)
        .map(|_| {
            let bytes = (0..20 * 15 * 3).map(|_| byte()).collect();
            Frame::new(FRAME, bytes).expect("whole")
        })
        .collect()
}

fn fit(name: &str, words: &[&str], spec: FeatureSpec) -> (Model, Features) {
    let frames = frames(60);
    let extractor = taceva_models::Extractor::new(spec, FRAME, None).expect("fits");
    let features = extractor.extract_all(&frames).expect("one kind");
    let channels = Channels::new([
        Channel::FZ,
        Channel::named("shear_x", Unit::Millimetre).expect("plain"),
    ])
    .expect("distinct");
    let labels: Vec<f64> = (0..60)
        .flat_map(|sample| {
            let pixels = features.sample(sample);
            [
                f64::from(pixels[3]) * 7.0 - f64::from(pixels[11]),
                f64::from(pixels[19]),
            ]
        })
        .collect();
    let rows: Vec<usize> = (0..60).collect();
    let (training, validation) = (features.select(&rows[..40]), features.select(&rows[40..]));
    let set = |features, values| TrainingSet {
        features,
        targets: Targets {
            channels: &channels,
            values,
        },
        groups: None,
    };
    let settings = Settings::parse(words.iter().copied()).expect("well formed");
    let estimator = find(name)
        .expect("registered")
        .estimator(&settings)
        .expect("valid");
    let input = FitInput {
        estimator: &*estimator,
        settings: &settings,
        features: spec,
        frame: FRAME,
        training: set(&training, &labels[..80]),
        validation: Some(set(&validation, &labels[80..])),
        provenance: Provenance {
            data: Some("sha256:00".into()),
            source: Source::Synthetic,
            split: Some(SplitCard {
                split: "random 70/20/10".into(),
                seed: 7,
            }),
            notes: vec!["random frames".into()],
        },
    };
    (
        Model::fit(input, &SilentProgress).expect("learnable"),
        features,
    )
}

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
    // All twenty components are a rotation, which least squares does not see; coordinates are rounded to f32.
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
fn a_model_of_statistics_says_so_and_one_of_pixels_says_what_it_always_said() {
    let of_statistics = FeatureSpec {
        kinds: FeatureKind::Statistics.into(),
        ..SPEC
    };
    let (model, features) = fit("ridge", &[], of_statistics);
    let opened = Model::from_bytes(&model.to_bytes().expect("small")).expect("opens");
    assert_eq!(opened.card().features, of_statistics);
    let predictions = [&opened, &model].map(|model| model.predict(&features).expect("finite"));
    assert_eq!(predictions[0], predictions[1]);
    // As older versions wrote it: their files open, and they open ours.
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
        "a frame of 21×15 rgb8 where 20×15 rgb8 is expected"
    );
}

#[test]
fn features_other_than_asked_for_are_refused() {
    let (model, _) = fit("ridge", &[], SPEC);
    let other = Features::new(FeatureShape::flat(20), vec![0.0; 20]).expect("whole");
    assert!(model.predict(&other).is_err());
}

#[test]
fn a_path_that_cannot_be_is_named() {
    let (model, _) = fit("baseline", &[], SPEC);
    let path = Path::new("no/such/folder/model.safetensors");
    let error = model.save(path).expect_err("no folder");
    assert!(matches!(error, ModelFileError::Write { .. }));
    assert!(
        error
            .to_string()
            .starts_with("cannot write model no/such/folder/model.safetensors: ")
    );
    assert!(matches!(
        Model::open(path),
        Err(ModelFileError::Read { .. })
    ));
}

/// A card with a seal that holds, over the tensors of the file as well.
fn sealed(card: &str, bytes: &[u8]) -> String {
    use sha2::Digest as _;
    let file = safetensors::SafeTensors::deserialize(bytes).expect("a whole file");
    let told = |(name, tensor): (String, safetensors::tensor::TensorView<'_>)| {
        let mut hasher = sha2::Sha256::new();
        hasher.update(format!("{:?} {:?} ", tensor.dtype(), tensor.shape()).as_bytes());
        hasher.update(tensor.data());
        (format!("tensor {name}"), hasher.finalize().to_vec())
    };
    let mut told: Vec<_> = file.tensors().into_iter().map(told).collect();
    told.sort();
    let attached: Vec<(&str, &[u8])> = told
        .iter()
        .map(|(name, digest)| (name.as_str(), digest.as_slice()))
        .collect();
    taceva_seal::json::seal_with(card, &attached).expect("a card")
}

/// A model's bytes with its card rewritten, and a seal that holds where its version has one.
fn with_card(bytes: &[u8], change: impl Fn(&mut serde_json::Value)) -> Vec<u8> {
    with_card_text(bytes, |card| {
        let mut card: serde_json::Value = serde_json::from_str(card).expect("a card");
        change(&mut card);
        card.as_object_mut().expect("an object").remove("seal");
        match card["format"].as_str() {
            Some("1.0") => card.to_string(),
            _ => sealed(&card.to_string(), bytes),
        }
    })
}

/// A model's bytes with the text of its card rewritten.
fn with_card_text(bytes: &[u8], change: impl Fn(&str) -> String) -> Vec<u8> {
    let length = u64::from_le_bytes(*bytes.first_chunk().expect("a header"));
    let end = 8 + usize::try_from(length).expect("small");
    let mut header: serde_json::Value = serde_json::from_slice(&bytes[8..end]).expect("a header");
    let text = header["__metadata__"]["taceva.model"]
        .as_str()
        .expect("a card");
    header["__metadata__"]["taceva.model"] = change(text).into();
    let mut text = header.to_string();
    while !text.len().is_multiple_of(8) {
        text.push(' ');
    }
    let mut changed = (text.len() as u64).to_le_bytes().to_vec();
    changed.extend(text.bytes());
    changed.extend(&bytes[end..]);
    changed
}

#[test]
fn a_number_a_setting_or_a_seal_that_is_another_one_is_refused_by_its_key() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    let refused = |bytes: &[u8]| {
        let error = Model::from_bytes(bytes).expect_err("changed");
        error.to_string()
    };
    let setting = with_card_text(&bytes, |card| {
        assert!(card.contains("\"difference\":false"), "{card}");
        card.replace("\"difference\":false", "\"difference\":true")
    });
    let message = refused(&setting);
    assert!(
        message.contains("`features.difference` was changed"),
        "{message}"
    );
    let mut weight = bytes.clone();
    *weight.last_mut().expect("a weight") ^= 1;
    let message = refused(&weight);
    assert!(message.contains("`tensor "), "{message}");
    let without = with_card_text(&bytes, |card| {
        let (card, _) = card.split_once(",\"seal\"").expect("a seal");
        format!("{card}}}")
    });
    assert!(refused(&without).contains("the seal is gone"));
    let older = with_card(&bytes, |card| card["format"] = "1.0".into());
    assert!(
        Model::from_bytes(&older).is_ok(),
        "files of before seals are read"
    );
}

#[test]
fn newer_minor_versions_are_read_and_newer_major_ones_refused() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    let minor = with_card(&bytes, |card| {
        card["format"] = "1.7".into();
        card["mood"] = "sunny".into();
    });
    assert!(Model::from_bytes(&minor).is_ok());
    for version in ["2.0", "0.9", "1", "one", ""] {
        let other = with_card(&bytes, |card| card["format"] = version.into());
        let error = Model::from_bytes(&other).expect_err(version);
        assert!(matches!(error, FormatError::Version { .. }), "{error}");
    }
}

#[test]
fn a_card_that_does_not_fit_its_tensors_is_refused() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    let refused = |change: fn(&mut serde_json::Value)| {
        let changed = with_card(&bytes, change);
        Model::from_bytes(&changed)
            .expect_err("refused")
            .to_string()
    };
    assert_eq!(
        refused(|card| card["features"]["width"] = 6.into()),
        "tensor `weights` is F64 [2, 20], the card says F64 [2, 24]"
    );
    assert!(refused(|card| card["features"]["width"] = 0.into()).contains("contradicts itself"));
    assert!(refused(|card| card["channels"][0]["unit"] = "mm".into()).contains("channel"));
    assert!(refused(|card| card["channels"][0]["name"] = "z y".into()).contains("channel"));
    assert!(refused(|card| card["features"]["smell"] = true.into()).contains("smell"));
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let sealed = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    // Where a seal would tell already, the number is never looked at.
    let mut bytes = with_card(&sealed, |card| card["format"] = "1.0".into());
    let end = bytes.len();
    bytes[end - 8..].copy_from_slice(&f64::NAN.to_le_bytes());
    let error = Model::from_bytes(&bytes).expect_err("refused");
    assert_eq!(error.to_string(), "a weight is not finite");
}

#[test]
fn a_huge_header_is_refused_before_it_is_read() {
    let error = Model::from_bytes(&[0xff; 64]).expect_err("refused");
    assert!(matches!(error, FormatError::HeaderSize { .. }));
    let foreign = safetensors::serialize::<&str, safetensors::tensor::TensorView<'_>, _>([], None);
    let error = Model::from_bytes(&foreign.expect("empty")).expect_err("refused");
    assert!(matches!(error, FormatError::NoCard));
}

#[test]
fn damaged_files_never_panic_and_truncated_ones_are_never_models() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    for length in 0..bytes.len() {
        assert!(
            Model::from_bytes(&bytes[..length]).is_err(),
            "{length} bytes"
        );
    }
    let seed = 20_261_121_u64;
    let mut state = seed;
    let mut next = |bound: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        usize::try_from(state >> 33).expect("31 bits") % bound
    };
    for round in 0..20_000 {
        let mut damaged = bytes.clone();
        for _ in 0..=next(4) {
            let position = next(damaged.len());
            damaged[position] = u8::try_from(next(256)).expect("a byte");
        }
        // What still opens has finite numbers of the shape its card names.
        if let Ok(model) = Model::from_bytes(&damaged) {
            let ModelRegressor::Linear(linear) = model.regressor() else {
                panic!("a linear model became another")
            };
            let weights = linear.weights();
            assert_eq!(
                weights.len(),
                model.channels().len() * model.card().features.shape().len(),
                "seed {seed}, round {round}"
            );
            assert!(weights.iter().all(|weight| weight.is_finite()));
        }
    }
}
