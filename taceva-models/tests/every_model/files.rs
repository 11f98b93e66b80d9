//! Tests of model files, whole and damaged.

use taceva_core::ErrorKind;
use taceva_models::Model;

use super::case::{bits, cases};
use crate::blobs::numbers;

#[test]
fn a_file_gives_the_same_model_and_the_same_bits() {
    for case in cases() {
        let (training, test) = (case.recording(40, 21), case.recording(9, 22));
        let components = case.components.then_some(Some(6));
        for pca in [None].into_iter().chain(components) {
            let model = case.model(&training, pca);
            let bytes = model.to_bytes().expect("small");
            let again = case
                .models()
                .read(&bytes)
                .unwrap_or_else(|error| panic!("{} {pca:?}: {error}", case.name));
            assert!(again == model, "{} {pca:?}", case.name);
            assert!(again.to_bytes().expect("small") == bytes, "{}", case.name);
            let found = |model: &Model| bits(&model.predict(&test.features).expect("finite"));
            assert_eq!(found(&again), found(&model), "{} {pca:?}", case.name);
            assert_eq!(model.reads_features(), !case.is_constant, "{}", case.name);
        }
    }
}

#[test]
fn no_damaged_file_panics() {
    let mut next = numbers(11);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place below the bound"
    )]
    let mut below = |bound: usize| (next() * bound as f64) as usize;
    for case in cases().filter(|case| case.components) {
        let (training, test) = (case.recording(16, 23), case.recording(2, 24));
        let bytes = case.model(&training, Some(3)).to_bytes().expect("small");
        let header = usize::from(u16::from_le_bytes([bytes[0], bytes[1]])) + 8;
        for _ in 0..1_000 {
            let mut damaged = bytes.clone();
            for _ in 0..=below(3) {
                let within = if below(2) > 0 { header } else { bytes.len() };
                damaged[below(within)] = u8::try_from(below(256)).expect("a byte");
            }
            if let Ok(opened) = case.models().read(&damaged) {
                // A number may have changed, but a prediction may fail only in the stated way.
                if let Err(error) = opened.predict(&test.features) {
                    let said = [ErrorKind::OutOfRange, ErrorKind::InvalidArgument];
                    assert!(said.contains(&error.kind()), "{}: {error}", case.name);
                }
            }
        }
    }
}
