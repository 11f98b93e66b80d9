//! Training distance in a model file.

use std::collections::HashMap;

use safetensors::SafeTensors;
use taceva_models::Model;

use super::refused::{sealed, with_card};
use super::{SPEC, fit};

/// Bytes of a model without the training distance, as older versions wrote it.
fn without_distance(bytes: &[u8]) -> Vec<u8> {
    let (_, header) = SafeTensors::read_metadata(bytes).expect("a header");
    let metadata = header.metadata().clone().expect("a card");
    let mut card: serde_json::Value =
        serde_json::from_str(&metadata["taceva.model"]).expect("a card");
    let card_fields = card.as_object_mut().expect("an object");
    card_fields.remove("distance").expect("there was one");
    card_fields.remove("seal");
    let opened = SafeTensors::deserialize(bytes).expect("whole");
    let kept: Vec<_> = opened
        .tensors()
        .into_iter()
        .filter(|(name, _)| !name.starts_with("distance."))
        .collect();
    assert_eq!(kept.len() + 3, opened.names().len());
    let of = |card: String| {
        let metadata = HashMap::from([("taceva.model".to_owned(), card)]);
        safetensors::serialize(kept.clone(), Some(metadata)).expect("small")
    };
    let unsealed = of(card.to_string());
    of(sealed(&card.to_string(), &unsealed))
}

#[test]
fn a_distance_comes_back_with_the_same_bits_and_a_file_of_before_has_none() {
    for words in [&[][..], &["refit=false"]] {
        let (model, features) = fit("ridge", words, SPEC);
        let bytes = model.to_bytes().expect("small");
        let again = Model::from_bytes(&bytes).expect("read");
        assert_eq!(again, model);
        let of = |model: &Model| model.distances(&features).expect("of its shape");
        assert_eq!(of(&again), of(&model));
        let earlier = Model::from_bytes(&without_distance(&bytes)).expect("of before");
        assert_eq!((earlier.feature_distance(), of(&earlier)), (None, None));
        assert_eq!(
            earlier.predict(&features).expect("finite"),
            model.predict(&features).expect("finite")
        );
    }
}

#[test]
fn limits_that_are_none_and_tensors_without_limits_are_refused() {
    let bytes = fit("ridge", &[], SPEC).0.to_bytes().expect("small");
    for (key, value) in [("along", 0.0), ("beside", -1.0), ("along", f64::MIN)] {
        let wrong = with_card(&bytes, |card| card["distance"][key] = value.into());
        let error = Model::from_bytes(&wrong).expect_err("no limit");
        assert!(error.to_string().contains("contradicts"), "{key}: {error}");
    }
    let lonely = with_card(&bytes, |card| {
        card.as_object_mut().expect("an object").remove("distance");
    });
    let error = Model::from_bytes(&lonely).expect_err("no limits");
    assert!(error.to_string().contains("distance."), "{error}");
}
