//! Rejected files: other files, and changed models.

use std::path::Path;

use taceva_models::{FormatError, LinearRegressor, Model, ModelFileError};

use super::{SPEC, fit};

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

/// Card with a valid seal, also over the tensors of the file.
pub(crate) fn sealed(card: &str, bytes: &[u8]) -> String {
    use sha2::Digest as _;
    let file = safetensors::SafeTensors::deserialize(bytes).expect("a whole file");
    let digested = |(name, tensor): (String, safetensors::tensor::TensorView<'_>)| {
        let mut hasher = sha2::Sha256::new();
        hasher.update(format!("{:?} {:?} ", tensor.dtype(), tensor.shape()).as_bytes());
        hasher.update(tensor.data());
        (format!("tensor {name}"), hasher.finalize().to_vec())
    };
    let mut digests: Vec<_> = file.tensors().into_iter().map(digested).collect();
    digests.sort();
    let attached: Vec<(&str, &[u8])> = digests
        .iter()
        .map(|(name, digest)| (name.as_str(), digest.as_slice()))
        .collect();
    taceva_files::seal::json::seal_with(card, &attached).expect("a card")
}

/// Bytes of a model with a changed card and a valid seal.
pub(crate) fn with_card(bytes: &[u8], change: impl Fn(&mut serde_json::Value)) -> Vec<u8> {
    with_card_text(bytes, |card| {
        let mut card: serde_json::Value = serde_json::from_str(card).expect("a card");
        change(&mut card);
        card.as_object_mut().expect("an object").remove("seal");
        sealed(&card.to_string(), bytes)
    })
}

/// Bytes of a model with a changed card text.
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
    assert!(refused(&without).contains("the seal is missing"));
}

#[test]
fn newer_minor_versions_are_read_and_newer_major_ones_refused() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    let of = |version: &str| {
        with_card(&bytes, |card| {
            card["format"] = version.into();
            card["taceva"] = "0.3.0".into();
            card["mood"] = "sunny".into();
        })
    };
    assert!(Model::from_bytes(&of("1.7")).is_ok());
    for version in ["2.0", "0.9", "1", "one", ""] {
        let error = Model::from_bytes(&of(version)).expect_err(version);
        assert!(matches!(error, FormatError::Version { .. }), "{error}");
    }
}

#[test]
fn files_of_earlier_formats_are_refused_with_the_command_that_makes_them_anew() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    let earlier = with_card(&bytes, |card| {
        card["format"] = "1.2".into();
        card["taceva"] = "0.1.0".into();
    });
    let error = Model::from_bytes(&earlier).expect_err("earlier");
    assert_eq!(
        error.to_string(),
        "format 1.2 of TacEva 0.1.0 is no longer read: fit the model again with `taceva fit RECORDING --model NAME --out FILE`"
    );
}

#[test]
fn a_model_that_is_not_registered_is_refused_by_its_name() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    let other = with_card(&bytes, |card| card["model"] = "rigde".into());
    assert_eq!(
        Model::from_bytes(&other).expect_err("unknown").to_string(),
        "fitted by `rigde`, which this TacEva does not have"
    );
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
        "tensor `weights` is F64 [2, 20], the card states F64 [2, 24]"
    );
    assert!(refused(|card| card["features"]["width"] = 0.into()).contains("contradicts itself"));
    assert!(refused(|card| card["channels"][0]["unit"] = "mm".into()).contains("channel"));
    assert!(refused(|card| card["channels"][0]["name"] = "z y".into()).contains("channel"));
    assert!(refused(|card| card["features"]["smell"] = true.into()).contains("smell"));
}

/// Offset of the end of a tensor in a file.
fn end_of(bytes: &[u8], tensor: &str) -> usize {
    let file = safetensors::SafeTensors::deserialize(bytes).expect("a whole file");
    let data = file.tensor(tensor).expect("there").data();
    data.as_ptr().addr() - bytes.as_ptr().addr() + data.len()
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    for (tensor, said) in [
        ("weights", "a weight is not finite"),
        ("distance.mean", "the card contradicts itself"),
        ("distance.deviations", "the card contradicts itself"),
        ("distance.directions", "the card contradicts itself"),
    ] {
        let mut bytes = bytes.clone();
        let end = end_of(&bytes, tensor);

        let nan: &[u8] = match tensor {
            "distance.directions" => &f32::NAN.to_le_bytes(),
            _ => &f64::NAN.to_le_bytes(),
        };
        bytes[end - nan.len()..end].copy_from_slice(nan);
        // The seal covers the new number.
        let bytes = with_card(&bytes, |_| {});
        let error = Model::from_bytes(&bytes).expect_err("refused").to_string();
        assert!(error.starts_with(said), "{tensor}: {error}");
    }
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
        // A file that still opens has finite values of the shape in its card.
        if let Ok(model) = Model::from_bytes(&damaged) {
            let linear = model.regressor().get::<LinearRegressor>();
            let linear = linear.expect("a linear model stays one");
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

#[test]
fn an_ensemble_whose_card_and_tensors_disagree_is_refused() {
    let spec = taceva_models::FeatureSpec {
        width: 10,
        height: 10,
        ..SPEC
    };
    let (model, features) = fit("cnn-ensemble", &["epochs=1", "batch=8"], spec);
    let bytes = model.to_bytes().expect("small");
    let again = Model::from_bytes(&bytes).expect("as it was written");
    assert_eq!(
        again.predict(&features).expect("finite"),
        model.predict(&features).expect("finite")
    );
    let cards = |card: &mut serde_json::Value| card["ensemble"].as_array().expect("cards").clone();
    let one = with_card(&bytes, |card| card["ensemble"] = cards(card)[..1].into());
    assert!(matches!(
        Model::from_bytes(&one),
        Err(FormatError::Unexpected { name }) if name.starts_with("member1.")
    ));
    let three = with_card(&bytes, |card| {
        let first = cards(card)[0].clone();
        card["ensemble"].as_array_mut().expect("cards").push(first);
    });
    assert!(Model::from_bytes(&three).is_err());
    let both = with_card(&bytes, |card| card["network"] = cards(card)[0].clone());
    assert!(matches!(Model::from_bytes(&both), Err(FormatError::Card)));
    let none = with_card(&bytes, |card| {
        card["ensemble"] = serde_json::Value::from(Vec::<u8>::new())
    });
    assert!(Model::from_bytes(&none).is_err());
}
