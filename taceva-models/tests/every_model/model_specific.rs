//! Guarantees of single models beyond the common ones.

use taceva_core::Features;
use taceva_models::Model;

use super::case::{case_of, predict};
use crate::blobs::{Recording, SHAPE, recording};

#[test]
fn deviations_of_a_gaussian_process_cover_its_errors() {
    let (training, test) = (recording(200, 31), recording(200, 32));
    let regressor = case_of("gaussian-process")
        .fitted(&training, None)
        .regressor;
    let found = predict(&regressor, &test.features);
    let deviations = regressor.deviations(&test.features).expect("its shape");
    let deviations = deviations.expect("known");
    let errors = found.iter().zip(&test.labels).map(|(a, b)| (a - b).abs());
    let inside = errors
        .zip(&deviations)
        .filter(|(error, deviation)| *error < 1.96 * **deviation);
    let coverage = inside.count() as f64 / found.len() as f64;
    // 0.95 is nominal; here every sample is a landmark.
    assert!((0.85..=1.0).contains(&coverage), "{coverage}");
    // A picture without a blob resembles no training picture.
    let empty = Features::new(SHAPE, vec![0.2; SHAPE.len()]).expect("one sample");
    let unsure = regressor
        .deviations(&empty)
        .expect("its shape")
        .expect("known");
    let mut sorted = deviations;
    sorted.sort_by(f64::total_cmp);
    assert!(unsure[0] > 2.0 * sorted[sorted.len() / 2], "{unsure:?}");
    let other = case_of("kernel-ridge").fitted(&training, None).regressor;
    assert!(other.deviations(&empty).expect("its shape").is_none());
}

#[test]
fn predictions_stay_within_the_bounds_outside_the_training_range() {
    let training = recording(60, 33);
    let model = case_of("ridge").model(&training, None);
    let glaring = training.features.values().iter().map(|value| 50.0 * value);
    let glaring = Features::new(SHAPE, glaring.collect()).expect("whole samples");
    let found = model.predict(&glaring).expect("finite");
    let free = model.predict_unbounded(&glaring).expect("finite");
    let counts = beyond(&model, &free);
    assert!(counts.iter().sum::<usize>() > 60, "{counts:?}");
    let mut bounded = free.clone();
    model.label_bounds().bound(&mut bounded);
    assert_eq!(bounded, found);
    for (position, count) in counts.into_iter().enumerate() {
        let [least, greatest] = model.label_bounds().of(position).expect("a new model");
        let card = &model.card().channels[position];
        assert!((least - (card.minimum - 0.25 * card.span)).abs() < 1e-9);
        let own = found.iter().skip(position).step_by(2);
        let on_bound = own.filter(|value| **value <= least || **value >= greatest);
        assert_eq!(on_bound.count(), count);
    }
    let seen = model.predict_unbounded(&training.features).expect("finite");
    assert_eq!(beyond(&model, &seen), [0, 0]);
}

/// Number of `predictions` beyond the bounds, by channel.
fn beyond(model: &Model, predictions: &[f64]) -> Vec<usize> {
    let channels = model.channels().len();
    let of = |position: usize| {
        let own = predictions.iter().skip(position).step_by(channels);
        own.filter(|value| model.label_bounds().is_beyond(position, **value) == Some(true))
            .count()
    };
    (0..channels).map(of).collect()
}

#[test]
fn cards_hold_the_mean_of_the_labels_and_the_baseline_predicts_it_to_the_last_bit() {
    let training = recording(61, 35);
    for name in ["baseline", "ridge"] {
        let model = case_of(name).model(&training, None);
        let found = model.predict(&training.features).expect("finite");
        for (position, card) in model.card().channels.iter().enumerate() {
            let own = || training.labels.iter().skip(position).step_by(2);
            let mean = own().sum::<f64>() / own().count() as f64;
            let known = card.mean;
            assert!((known - mean).abs() < 1e-12, "{name}: {known}, {mean}");
            if name == "baseline" {
                assert_eq!(found[position].to_bits(), known.to_bits());
            }
        }
    }
}

#[test]
fn a_choice_among_models_says_what_was_tried_and_keeps_the_one_it_took() {
    let training = recording(40, 34);
    let model = case_of("auto").model(&training, None);
    let card = model.card();
    let auto = card.auto.as_ref().expect("chosen");
    let best = auto.best().expect("tried");
    assert_eq!(
        (best.model.as_str(), card.model.as_str()),
        ("ridge", "ridge")
    );
    assert!(auto.tried.iter().any(|trial| trial.model == "baseline"));
    let unaffordable = auto.untried.iter().find(|untried| untried.model == "knn");
    let reason = &unaffordable.expect("untried").reason;
    assert!(reason.starts_with("beyond the budget: "), "{reason}");
    let said = auto.to_string();
    assert!(said.starts_with("auto chose ridge; error "), "{said}");
    let alone = case_of("ridge").model(&training, None);
    assert_eq!(model.regressor(), alone.regressor());
}

#[test]
fn levels_are_predicted_as_classes_and_too_many_are_refused() {
    let levels = |mut recording: Recording| {
        // Thirds of the gel, as label values that arithmetic does not produce by chance.
        let level = |label: &mut f64| *label = 0.1 + (*label / 8.0).floor() / 3.0;
        recording.labels.iter_mut().for_each(level);
        recording
    };
    let (training, test) = (levels(recording(400, 35)), levels(recording(100, 36)));
    let found = predict(
        &case_of("lda").fitted(&training, None).regressor,
        &test.features,
    );
    assert!(found.iter().all(|value| training.labels.contains(value)));
    let right = found
        .iter()
        .zip(&test.labels)
        .filter(|(a, b)| a.to_bits() == b.to_bits());
    // A blob near the edge of a third looks like one in the next third.
    assert!(right.count() > 180);

    let said = case_of("lda").refusal(&recording(257, 37), None);
    assert_eq!(
        said,
        "`Px` has 257 values in the training part, discriminants accept at most 256 classes: for continuous labels choose another model, \
         such as ridge"
    );
}
