//! Tests of scores of models that were trained once or several times.

use super::pairs::sampled;
use super::variants::with_variant;
use super::{errors, of_metric};
use taceva_core::Unit;
use taceva_report::Study;
use taceva_results::{OverSeeds, SeedScore};

/// Scores of `metric` on Fz for three seeds; the first is that of the report.
pub(crate) fn over_seeds(metric: &str, values: [f64; 3]) -> OverSeeds {
    OverSeeds {
        seeds: vec![11, 12, 13],
        decides: "first weights".to_owned(),
        scores: vec![SeedScore {
            metric: metric.to_owned(),
            channel: "Fz".to_owned(),
            unit: Unit::Newton,
            values: values.map(Some).to_vec(),
            mean: values.iter().sum::<f64>() / 3.0,
            standard_deviation: 0.0,
            interval: [0.0, 1.0],
        }],
    }
}

#[test]
fn a_difference_of_one_training_of_a_model_that_draws_says_so() {
    let compared = |settings: [&[(&str, &str)]; 2], seeds: bool| {
        let mut studies = errors(&[("Coarse", 0.75), ("Fine", 0.25)]);
        for (study, of) in studies.iter_mut().zip(settings) {
            let of = of.iter();
            study.made.settings = of.map(|&(key, value)| (key.into(), value.into())).collect();
            let values = [0.5, 0.501, 0.499];
            study.over_seeds = seeds.then(|| over_seeds("mae", values));
        }
        let comparison = of_metric(&studies, "mae");
        let words = comparison.answers[0].words(&comparison.names);
        let note = comparison
            .notes
            .iter()
            .find(|note| note.contains("--seeds"));
        (words, note.cloned())
    };
    let drawn: &[(&str, &str)] = &[("epochs", "24"), ("seed", "11")];
    let (words, note) = compared([drawn, drawn], false);
    assert!(
        words.ends_with("; only one training of Coarse and Fine"),
        "{words}"
    );
    assert!(
        note.expect("a note")
            .contains("one training of Coarse and Fine")
    );
    let (words, _) = compared([&[], drawn], false);
    assert!(words.ends_with("; only one training of Fine"), "{words}");
    // Ridge draws nothing, and several trainings enter the verdict.
    for (settings, seeds) in [([&[][..], &[]], false), ([drawn, drawn], true)] {
        let (words, note) = compared(settings, seeds);
        assert!(!words.contains("training") && note.is_none(), "{words}");
    }
}

/// p value, interval width and test of the first answer.
fn tested(studies: &[Study], metric: &str) -> (f64, f64, String) {
    let comparison = of_metric(studies, metric);
    let difference = comparison.answers[0].difference.clone().expect("tested");
    let [low, high] = difference.interval;
    (difference.p, high - low, difference.test.to_string())
}

#[test]
fn the_variance_between_trainings_widens_a_difference_of_different_samples() {
    let mut studies = errors(&[("one", 0.54), ("two", 0.5)]);
    let (p, width, _) = tested(&studies, "mae");
    assert!(p < 0.05, "{p}");
    // Equal trainings change no bit.
    studies[0].over_seeds = Some(over_seeds("mae", [0.54; 3]));
    let (same, of_same, _) = tested(&studies, "mae");
    assert_eq!(
        (same.to_bits(), of_same.to_bits()),
        (p.to_bits(), width.to_bits())
    );
    studies[0].over_seeds = Some(over_seeds("mae", [0.54, 0.58, 0.5]));
    let (over, wider, test) = tested(&studies, "mae");
    assert!(over > 0.05 && wider > 2.0 * width, "{over} {wider}");
    assert_eq!(test, "by the intervals of both");
    // Seeds of another metric are ignored.
    studies[0].over_seeds = Some(over_seeds("rmse", [0.54, 0.58, 0.5]));
    let (other, ..) = tested(&studies, "mae");
    assert_eq!(other.to_bits(), p.to_bits());
}

#[test]
fn the_variance_between_trainings_widens_a_difference_of_the_same_samples() {
    let mut studies = [sampled("a", 0.0, 0.25), sampled("b", 0.0, 0.5)];
    let (p, _, test) = tested(&studies, "mae");
    assert!(p < 0.05 && test.contains("sign"), "{p} {test}");
    studies[1].over_seeds = Some(over_seeds("mae", [0.5, 0.9, 0.1]));
    let (over, _, test) = tested(&studies, "mae");
    assert!(over > 0.05, "{over}");
    assert_eq!(
        test,
        "paired t by cluster with the variance between trainings, G=12"
    );
    studies[1].over_seeds = Some(over_seeds("mae", [0.5; 3]));
    let (same, _, test) = tested(&studies, "mae");
    assert!(test.contains("sign"), "{test}");
    assert_eq!(same.to_bits(), p.to_bits());
}

#[test]
fn a_variant_that_decides_takes_its_own_variance_between_trainings() {
    let mut studies = [
        with_variant("one", "repeatability", 0.2, "pooled", 0.25),
        with_variant("two", "repeatability", 0.2, "pooled", 0.2),
    ];
    let (p, width, _) = tested(&studies, "repeatability");
    assert!(p < 0.05, "{p}");
    studies[0].over_seeds = Some(over_seeds("repeatability", [0.2, 0.3, 0.1]));
    let (of_value, ..) = tested(&studies, "repeatability");
    assert_eq!(of_value.to_bits(), p.to_bits());
    studies[0].over_seeds = Some(over_seeds("repeatability.pooled", [0.25, 0.29, 0.21]));
    let (over, wider, _) = tested(&studies, "repeatability");
    assert!(over > p && wider > width, "{over} {wider}");
}
