//! Losses and calibration of probabilities.

use crate::golden::{score, value};
use taceva_metrics::Interval;
use taceva_tasks::{Probabilities, Undefined};

fn slip() -> Probabilities {
    Probabilities::new(["no_slip", "slip"], Some("slip")).expect("names")
}

#[test]
fn the_constant_to_beat_is_the_share_of_each_class() {
    let mut slip = slip();
    for truth in ["slip", "no_slip", "no_slip", "no_slip"] {
        slip.push("stroke", truth, &[0.5, 0.5])
            .expect("probabilities");
    }
    let scores = slip.scores();
    assert_eq!(value(&scores, "brier", None), Ok(0.25));
    assert_eq!(
        score(&scores, "brier", None).estimate.of_constant,
        Some(0.1875)
    );
    let loss = &score(&scores, "log_loss", None).estimate;
    assert!(
        loss.value
            .is_ok_and(|loss| (loss - 2.0_f64.ln()).abs() < 1e-15)
    );
    let of_shares = -(0.25 * 0.25_f64.ln() + 0.75 * 0.75_f64.ln());
    assert!(
        loss.of_constant
            .is_some_and(|loss| (loss - of_shares).abs() < 1e-15)
    );
    // All predicted 0.5, a quarter is true.
    assert_eq!(value(&scores, "ece", None), Ok(0.25));
}

#[test]
fn more_than_two_classes_have_the_sum_of_squares_and_no_calibration() {
    let mut textile = Probabilities::new(["a", "b", "c"], None).expect("names");
    textile
        .push("clip", "b", &[0.25, 0.5, 0.25])
        .expect("probabilities");
    let scores = textile.scores();
    // 1/16 + 1/4 + 1/16.
    assert_eq!(value(&scores, "brier", None), Ok(0.375));
    let loss = value(&scores, "log_loss", None);
    assert!(loss.is_ok_and(|loss| (loss - 2.0_f64.ln()).abs() < 1e-15));
    assert!(scores.iter().all(|score| score.metric != "ece"));
    assert!(textile.ranking().is_none());
}

#[test]
fn numbers_that_sum_to_0_7_have_no_losses_and_the_reason() {
    let mut slip = slip();
    slip.push("stroke 1", "slip", &[0.25, 0.75])
        .expect("probabilities");
    slip.push("stroke 2", "slip", &[0.25, 0.45])
        .expect("two numbers");
    for score in slip.scores() {
        let reason = score.estimate.value.expect_err("no probabilities");
        assert_eq!(reason, Undefined::NotProbabilities, "{}", score.metric);
        assert!(
            reason
                .to_string()
                .starts_with("the scores are not probabilities: ")
        );
        // A constant of the other rows alone would be one of other samples.
        assert_eq!(score.estimate.of_constant, None, "{}", score.metric);
    }
    // They still rank.
    assert_eq!(slip.ranking().map(|ranking| ranking.n()), Some(2));
}

#[test]
fn numbers_outside_0_to_1_have_no_losses() {
    let mut slip = slip();
    slip.push("stroke", "slip", &[-0.5, 1.5])
        .expect("two numbers");
    let brier = value(&slip.scores(), "brier", None);
    assert_eq!(brier, Err(Undefined::NotProbabilities));
}

#[test]
fn a_class_of_probability_0_that_is_true_has_an_infinite_loss() {
    let mut slip = slip();
    slip.push("stroke", "slip", &[1.0, 0.0])
        .expect("probabilities");
    let scores = slip.scores();
    assert_eq!(
        value(&scores, "log_loss", None),
        Err(Undefined::InfiniteLoss)
    );
    assert_eq!(value(&scores, "brier", None), Ok(1.0));
    assert_eq!(value(&scores, "ece", None), Ok(1.0));
}

#[test]
fn rounding_within_a_millionth_is_still_a_sum_of_1() {
    let mut textile = Probabilities::new(["a", "b", "c"], None).expect("names");
    textile
        .push("clip", "a", &[0.333_333_3; 3])
        .expect("probabilities");
    assert!(value(&textile.scores(), "log_loss", None).is_ok());
}

#[test]
fn a_loss_has_an_interval_on_the_scale_of_its_logarithm() {
    let mut slip = slip();
    for stroke in 0..8_u32 {
        let p = f64::from(stroke + 4) / 16.0;
        slip.push(&stroke.to_string(), "slip", &[1.0 - p, p])
            .expect("probabilities");
    }
    let scores = slip.scores();
    let interval: Interval = score(&scores, "brier", None).estimate.interval;
    assert_eq!(
        interval.method().as_deref(),
        Some("jackknife by group, G=8, logarithmic")
    );
    assert!(
        interval
            .ends()
            .is_some_and(|[low, high]| 0.0 < low && low < high)
    );
}

#[test]
fn no_sample_has_no_loss() {
    for score in slip().scores() {
        assert_eq!(
            score.estimate.value,
            Err(Undefined::Empty),
            "{}",
            score.metric
        );
    }
}

#[test]
fn losses_beat_a_constant_from_below() {
    let mut slip = slip();
    for stroke in 0..20_u32 {
        let p = 0.875 + f64::from(stroke % 3) / 32.0;
        slip.push(&stroke.to_string(), "slip", &[1.0 - p, p])
            .expect("probabilities");
        slip.push(&stroke.to_string(), "no_slip", &[p, 1.0 - p])
            .expect("probabilities");
    }
    let scores = slip.scores();
    assert!(score(&scores, "brier", None).beats_constant());
    assert!(score(&scores, "log_loss", None).beats_constant());
    assert!(!score(&scores, "ece", None).beats_constant());
}
