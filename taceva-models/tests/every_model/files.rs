//! Models in files, whole and damaged.

use taceva_core::ErrorKind;
use taceva_models::Model;

use crate::blobs::{numbers, recording};
use crate::case::{CASES, bits};
use crate::models;

#[test]
fn a_file_gives_the_same_model_and_the_same_bits() {
    let (training, test) = (recording(40, 21), recording(9, 22));
    for case in CASES {
        let components = case.components.then_some(Some(6));
        for pca in [None].into_iter().chain(components) {
            let model = case.model(&training, pca);
            let bytes = model.to_bytes().expect("small");
            let again = models()
                .read(&bytes)
                .unwrap_or_else(|error| panic!("{} {pca:?}: {error}", case.name));
            assert!(again == model, "{} {pca:?}", case.name);
            assert!(again.to_bytes().expect("small") == bytes, "{}", case.name);
            let found = |model: &Model| bits(&model.predict(&test.features).expect("finite"));
            assert_eq!(found(&again), found(&model), "{} {pca:?}", case.name);
            assert_eq!(model.reads_features(), case.name != "baseline");
        }
    }
}

#[test]
fn no_damaged_file_panics() {
    let (training, test) = (recording(16, 23), recording(2, 24));
    let mut next = numbers(11);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place below the bound"
    )]
    let mut below = |bound: usize| (next() * bound as f64) as usize;
    for case in CASES.iter().filter(|case| case.components) {
        let bytes = case.model(&training, Some(3)).to_bytes().expect("small");
        let header = usize::from(u16::from_le_bytes([bytes[0], bytes[1]])) + 8;
        for _ in 0..1_000 {
            let mut damaged = bytes.clone();
            for _ in 0..=below(3) {
                let within = if below(2) > 0 { header } else { bytes.len() };
                damaged[below(within)] = u8::try_from(below(256)).expect("a byte");
            }
            if let Ok(opened) = models().read(&damaged) {
                // A number may have changed, but never so that predicting fails in any but the said way.
                if let Err(error) = opened.predict(&test.features) {
                    let said = [ErrorKind::OutOfRange, ErrorKind::InvalidArgument];
                    assert!(said.contains(&error.kind()), "{}: {error}", case.name);
                }
            }
        }
    }
}
