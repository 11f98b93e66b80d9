//! Tests of invalid training data, and of cancelled fits.

use std::sync::atomic::{AtomicUsize, Ordering};

use taceva_core::{ErrorKind, FeatureShape, Features, Progress, Regressor};

use super::case::cases;
use crate::blobs::Recording;

#[test]
fn as_many_samples_as_are_needed_are_enough_and_one_less_is_refused() {
    for case in cases() {
        case.fitted(&case.recording(case.least, 7), None);
        let said = case.refusal(&case.recording(case.least - 1, 7), None);
        let few = taceva_core::counted(case.least - 1, "training sample") + ", ";
        assert!(said.starts_with(&few), "{}: {said}", case.name);
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused_where_they_stand() {
    for case in cases() {
        let clean = case.recording(24, 8);
        let mut values = clean.features.values().to_vec();
        values[case.blob.shape.len() * 3 + 2] = f32::NAN;
        let broken = Recording {
            features: Features::new(case.blob.shape, values).expect("whole"),
            ..clean.clone()
        };
        let mut mislabelled = clean.clone();
        mislabelled.labels[2 * 5 + 1] = f64::INFINITY;
        let said = case.refusal(&broken, None);
        assert_eq!(
            said, "training sample 3: feature 2 is not finite",
            "{}",
            case.name
        );
        let said = case.refusal(&clean, Some(&broken));
        assert_eq!(
            said, "validation sample 3: feature 2 is not finite",
            "{}",
            case.name
        );
        let said = case.refusal(&mislabelled, None);
        assert_eq!(
            said, "training sample 5: `Py` is not finite",
            "{}",
            case.name
        );
    }
}

#[test]
fn parts_that_do_not_fit_each_other_are_refused() {
    for case in cases() {
        let training = case.recording(24, 9);
        let mut other = case.recording(24, 9);
        other.features = Features::new(FeatureShape::flat(20), vec![0.5; 480]).expect("whole");
        let said = case.refusal(&training, Some(&other));
        let expected = format!(
            "validation samples of 20 features, expected {} as in training",
            case.blob.shape.len()
        );
        assert_eq!(said, expected, "{}", case.name);
        let regressor = case.fitted(&training, None).regressor;
        let error = regressor
            .predict(&other.features, &mut [0.0; 48])
            .expect_err("shape");
        assert_eq!(error.kind(), ErrorKind::InvalidArgument, "{}", case.name);
        let error = regressor
            .predict(&training.features, &mut [0.0; 6])
            .expect_err("buffer");
        assert_eq!(
            error.to_string(),
            "a buffer of 6 values, expected 24 samples × 2 channels"
        );
    }
}

/// Progress receiver that cancels after a number of progress queries.
struct Cancel(usize, AtomicUsize);

impl Progress for Cancel {
    fn is_cancelled(&self) -> bool {
        self.1.fetch_add(1, Ordering::Relaxed) >= self.0
    }
}

#[test]
fn a_cancelled_fit_stops_with_an_error() {
    for case in cases().filter(|case| !case.is_constant) {
        let training = case.recording(24, 25);
        for after in 0..2 {
            let progress = Cancel(after, AtomicUsize::new(0));
            let result = case.estimator().fit_model(&training.set(), None, &progress);
            let error = result
                .err()
                .unwrap_or_else(|| panic!("{} went on", case.name));
            assert_eq!(error.kind(), ErrorKind::Interrupted, "{}", case.name);
        }
    }
}
