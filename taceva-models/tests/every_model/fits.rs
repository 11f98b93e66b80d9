//! Tests of fits of every model, from a blob to a constant label.

use taceva_core::Features;

use super::case::{bits, cases, predict, rms};

#[test]
fn a_blob_is_found_with_and_without_a_validation_part() {
    for case in cases().filter(|case| case.error.is_finite()) {
        let (training, held, test) = (
            case.recording(160, 1),
            case.recording(40, 2),
            case.recording(60, 3),
        );
        for validation in [None, Some(&held)] {
            let fit = case.fitted(&training, validation);
            let found = predict(&fit.regressor, &test.features);
            assert_eq!(found.len(), 120);
            let error = rms(&found, &test.labels);
            assert!(error < case.error, "{}: {error}", case.name);
            if validation.is_some() {
                let said = fit.choice.channels[0].rmse.expect("measured");
                assert!(said < 1.5 * case.error, "{}: {said}", case.name);
            }
        }
    }
}

#[test]
fn a_constant_label_is_predicted_exactly_and_named() {
    for case in cases().filter(|case| !case.deeper) {
        let mut training = case.recording(24, 1);
        let second = training.labels.iter_mut().skip(1).step_by(2);
        second.for_each(|label| *label = 0.1);
        for held in [None, Some(&training)] {
            let fit = case.fitted(&training, held);
            let found = predict(&fit.regressor, &case.recording(5, 7).features);
            let exact = |value: &f64| value.to_bits() == 0.1_f64.to_bits();
            assert!(found.iter().skip(1).step_by(2).all(exact), "{}", case.name);
            assert!(!fit.scaling.is_constant(0) && fit.scaling.is_constant(1));
        }
    }
}

#[test]
fn features_that_never_change_give_a_number() {
    for case in cases().filter(|case| case.error.is_finite()) {
        let mut training = case.recording(24, 1);
        training.features =
            Features::new(case.blob.shape, vec![0.25; 24 * case.blob.shape.len()]).expect("whole");
        let (least, most) = training.labels.iter().step_by(2).fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(least, most), label| (least.min(*label), most.max(*label)),
        );
        let fit = case.fitted(&training, None);
        let found = predict(&fit.regressor, &training.features)[0];
        assert!((least..=most).contains(&found), "{}: {found}", case.name);
    }
}

#[test]
fn the_unit_of_labels_does_not_matter() {
    for case in cases().filter(|case| !case.deeper) {
        let (training, test) = (case.recording(60, 16), case.recording(20, 17));
        let mut larger = training.clone();
        // A power of two changes no digits.
        larger.labels.iter_mut().for_each(|label| *label *= 1024.0);
        let small = predict(&case.fitted(&training, None).regressor, &test.features);
        let large = predict(&case.fitted(&larger, None).regressor, &test.features);
        let expected: Vec<f64> = small.iter().map(|value| value * 1024.0).collect();
        assert_eq!(bits(&large), bits(&expected), "{}", case.name);
    }
}
