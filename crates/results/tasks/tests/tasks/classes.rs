//! Scores of classes, compared with exact fractions.

use crate::golden::{classes, entries, fraction, name, same, score, tasks, value};
use serde_json::Value;
use taceva_metrics::{ClusteredBy, Interval, LeftOut, Range, UndefinedReason};
use taceva_tasks::{Classes, TaskScore, Undefined};

#[test]
fn every_exact_fraction_of_labels_comes_out_rounded_once() {
    let golden = tasks();
    for set in entries(&golden, "classification") {
        let exact = &set["exact"];
        let scores = classes(set).scores();
        for (key, metric, variant) in [
            ("accuracy", "class_accuracy", None),
            ("balanced_accuracy", "balanced_accuracy", None),
            ("macro_f1_of_classes_seen", "f1_macro", None),
            ("macro_f1_of_classes_in_truth", "f1_macro", Some("in_truth")),
            (
                "macro_f1_all_labels_absent_as_0",
                "f1_macro",
                Some("all_names"),
            ),
            ("weighted_f1", "f1_macro", Some("weighted")),
            ("kappa", "kappa", None),
        ] {
            let found = value(&scores, metric, variant).ok();
            same(
                found,
                fraction(&exact[key]),
                &format!("{}, {key}", name(set)),
            );
        }
        let constant = score(&scores, "class_accuracy", None).estimate.of_constant;
        same(
            constant,
            fraction(&exact["accuracy_of_constant"]),
            name(set),
        );
        for (key, metric) in [
            ("recall", "recall"),
            ("precision", "precision"),
            ("f1", "f1_macro"),
        ] {
            for (class, expected) in entries(exact, key).iter().enumerate() {
                let found = value(&scores, metric, Some(&format!("class {class}"))).ok();
                same(
                    found,
                    fraction(expected),
                    &format!("{}, {key} {class}", name(set)),
                );
            }
        }
        // One root: the golden value has its own roundings.
        match (value(&scores, "mcc", None).ok(), exact["mcc"].as_f64()) {
            (Some(found), Some(expected)) => assert!((found - expected).abs() < 1e-15),
            (found, expected) => same(found, expected, name(set)),
        }
    }
}

#[test]
fn the_confusion_has_the_counts_of_each_pair_of_classes() {
    let golden = tasks();
    for set in entries(&golden, "classification") {
        let classes = classes(set);
        let mut counted = 0;
        for cell in classes.confusion() {
            let [truth, predicted]: [usize; 2] =
                [cell.truth, cell.predicted].map(|name| name.parse().expect("a position"));
            let expected = set["exact"]["confusion"][truth][predicted].as_u64();
            assert_eq!(Some(cell.count), expected, "{}", name(set));
            counted += cell.count;
        }
        assert_eq!(counted, classes.n());
    }
}

/// State of two classes with the given counts in each of `clusters` clusters.
fn of_two(clusters: u32, cells: [[u64; 2]; 2]) -> Classes {
    let mut classes = Classes::new(["no_slip", "slip"], Some("slip")).expect("names");
    for cluster in 0..clusters {
        for (truth, row) in (0_u32..).zip(cells) {
            for (predicted, count) in (0_u32..).zip(row) {
                for _ in 0..count {
                    let pushed =
                        classes.push_positions(&cluster.to_string(), &[truth], &[predicted]);
                    pushed.expect("positions");
                }
            }
        }
    }
    classes
}

#[test]
fn one_class_in_truth_and_predictions_leaves_the_accuracy_alone() {
    let scores = of_two(1, [[4, 0], [0, 0]]).scores();
    assert_eq!(value(&scores, "class_accuracy", None), Ok(1.0));
    assert_eq!(value(&scores, "kappa", None), Err(Undefined::OneClass));
    assert_eq!(value(&scores, "mcc", None), Err(Undefined::OneClass));
    assert_eq!(value(&scores, "f1", None), Err(Undefined::NoPositive));
    assert_eq!(value(&scores, "specificity", None), Ok(1.0));
}

#[test]
fn no_sample_has_no_score() {
    for score in of_two(0, [[0; 2]; 2]).scores() {
        assert_eq!(
            score.estimate.value,
            Err(Undefined::Empty),
            "{}",
            score.metric
        );
        assert_eq!(
            score.estimate.interval,
            Interval::Undefined(UndefinedReason::Empty)
        );
    }
}

#[test]
fn the_constant_to_beat_is_all_positive_for_f1_and_the_most_frequent_class_for_the_rest() {
    // π = 1/4.
    let scores = of_two(1, [[2, 1], [0, 1]]).scores();
    let of = |metric, variant| score(&scores, metric, variant).estimate.of_constant;
    // 2π / (1 + π) = 0.4; most frequent: F1 = 6/7, over both classes 3/7, weighted 9/14.
    assert_eq!(of("f1", None), Some(0.4));
    assert_eq!(of("class_accuracy", None), Some(0.75));
    assert_eq!(of("balanced_accuracy", None), Some(0.5));
    assert_eq!(of("f1_macro", None), Some(3.0 / 7.0));
    assert_eq!(of("f1_macro", Some("weighted")), Some(9.0 / 14.0));
    assert_eq!(of("f1_macro", Some("class slip")), Some(0.4));
    assert_eq!((of("kappa", None), of("mcc", None)), (Some(0.0), Some(0.0)));
    assert_eq!((of("precision", None), of("recall", None)), (None, None));
}

#[test]
fn fewer_than_five_clusters_give_no_interval() {
    let scores = of_two(4, [[2, 1], [0, 1]]).scores();
    for score in scores {
        let expected = UndefinedReason::TooFewClusters { have: 4 };
        assert_eq!(
            score.estimate.interval,
            Interval::Undefined(expected),
            "{}",
            score.metric
        );
    }
}

#[test]
fn a_perfect_accuracy_has_an_interval_from_as_many_samples_as_clusters() {
    let scores = of_two(20, [[3, 0], [0, 2]]).scores();
    let found = score(&scores, "class_accuracy", None);
    let [low, high] = found.estimate.interval.ends().expect("twenty clusters");
    // t(19)² = 4.381: 20 / 24.381.
    assert!((low - 0.8203).abs() < 5e-5 && high >= 1.0, "{low} {high}");
    assert!(found.beats_constant());
}

#[test]
fn wilson_stands_beside_the_shares_of_samples_alone() {
    let scores = of_two(5, [[2, 1], [0, 1]]).scores();
    let beside = |metric| score(&scores, metric, None).if_frames_were_independent;
    assert_eq!(beside("class_accuracy"), Some(Interval::wilson(15, 20)));
    assert_eq!(beside("precision"), Some(Interval::wilson(5, 10)));
    assert_eq!(beside("recall"), Some(Interval::wilson(5, 5)));
    assert_eq!(beside("specificity"), Some(Interval::wilson(10, 15)));
    assert_eq!((beside("f1"), beside("kappa")), (None, None));
}

#[test]
fn a_score_that_one_cluster_alone_defines_has_a_value_and_no_interval() {
    let mut slip = of_two(5, [[3, 0], [0, 0]]);
    slip.push("the one that slips", "slip", "slip")
        .expect("names");
    let scores = slip.scores();
    let recall = &score(&scores, "recall", None).estimate;
    assert_eq!(recall.value, Ok(1.0));
    let expected = UndefinedReason::HangsOnOneCluster;
    assert_eq!(recall.interval, Interval::Undefined(expected));
}

#[test]
fn a_rule_stands_in_each_definition_and_other_rules_do_not_merge() {
    let rule = "threshold 0.4 strict, debounce 3";
    let of_rule = of_two(5, [[2, 1], [0, 1]]).after_rule(rule);
    let is_named = |score: &TaskScore| score.definition.ends_with(rule);
    assert!(of_rule.scores().iter().all(is_named));
    let refused = of_rule.merge(of_two(5, [[2, 1], [0, 1]]));
    let text = refused
        .map_err(|error| error.to_string())
        .expect_err("another rule");
    assert!(
        text.starts_with("states of different rule do not merge"),
        "{text}"
    );
}

#[test]
fn columns_and_single_rows_give_one_state() {
    // 300 classes are counted row by row, two in a table.
    for classes in [2_u32, 300] {
        let names: Vec<String> = (0..classes).map(|class| format!("class {class}")).collect();
        let truth: Vec<u32> = (0..1000).map(|row| row * 7 % classes).collect();
        let predicted: Vec<u32> = (0..1000).map(|row| row * 11 % classes).collect();
        let mut columns = Classes::new(names.clone(), None).expect("names");
        columns
            .push_positions("clip", &truth, &predicted)
            .expect("positions");
        let mut rows = Classes::new(names.clone(), None).expect("names");
        for (truth, predicted) in truth.iter().zip(&predicted) {
            let [truth, predicted] = [truth, predicted].map(|at| names[*at as usize].as_str());
            rows.push("clip", truth, predicted).expect("names");
        }
        assert_eq!(columns, rows);
    }
}

#[test]
fn a_million_samples_of_a_thousand_classes_keep_a_cell_for_each_pair_that_occurs() {
    const CLASSES: u32 = 1000;
    const ROWS: u32 = 1_000_000;
    let names = (0..CLASSES).map(|class| class.to_string());
    let mut classes = Classes::new(names, None).expect("names");
    let truth: Vec<u32> = (0..ROWS).map(|row| row % CLASSES).collect();
    let predicted: Vec<u32> = (0..ROWS)
        .map(|row| (row + row / CLASSES % 3) % CLASSES)
        .collect();
    classes
        .push_positions("clip", &truth, &predicted)
        .expect("positions");
    // Three predictions of each class: 3,000 of a million cells.
    assert_eq!(classes.confusion().len(), 3000);
    let written = serde_json::to_vec(&classes).expect("JSON");
    assert!(written.len() < 64 << 20, "{}", written.len());
    let accuracy = value(&classes.scores(), "class_accuracy", None);
    assert_eq!(accuracy, Ok(0.334));
}

#[test]
fn scores_are_written_with_their_reasons() -> Result<(), serde_json::Error> {
    let scores = of_two(1, [[4, 0], [0, 0]]).scores();
    let written: Value = serde_json::to_value(score(&scores, "kappa", None))?;
    assert_eq!(written["metric"], "kappa");
    assert_eq!(written["estimate"]["value"], Value::Null);
    assert_eq!(written["estimate"]["undefined"], "one class only");
    assert_eq!(written["estimate"]["n"], 4);
    Ok(())
}

/// State with the true and predicted classes of each clip, named by its number.
fn of_clips<'a>(clips: impl Iterator<Item = (usize, &'a [[&'a str; 2]])>) -> Classes {
    let mut classes = Classes::new(["denim", "silk", "wool"], None).expect("names");
    for (number, rows) in clips {
        for [truth, predicted] in rows {
            let pushed = classes.push(&number.to_string(), truth, predicted);
            pushed.expect("known names");
        }
    }
    classes
}

#[test]
fn the_interval_of_a_class_leaves_out_clips_with_it_and_without_it() {
    let clips: [&[[&str; 2]]; 6] = [
        &[["silk", "silk"], ["denim", "denim"]],
        &[["silk", "wool"], ["silk", "silk"]],
        // Without silk.
        &[["denim", "denim"], ["wool", "denim"], ["wool", "wool"]],
        &[["denim", "silk"]],
        &[["silk", "silk"], ["wool", "wool"]],
        &[["denim", "wool"]],
    ];
    let of = |left_out: Option<usize>| {
        let numbered = clips.iter().copied().enumerate();
        let scores = of_clips(numbered.filter(|(number, _)| Some(*number) != left_out)).scores();
        let silk = Some("class silk");
        ["f1_macro", "precision", "recall"]
            .map(|metric| score(&scores, metric, silk).estimate.clone())
    };
    for (metric, found) in of(None).into_iter().enumerate() {
        let without = clips.iter().enumerate().map(|(number, rows)| {
            let value = of(Some(number))[metric].value;
            LeftOut::new(rows.len() as u64, Ok(value.expect("silk in others")))
        });
        let value = found.value.expect("silk");
        let without: Vec<LeftOut> = without.collect();
        let expected = Interval::jackknife(value, Range::Ratio, &without, ClusteredBy::Group);
        assert_eq!(found.interval, expected);
    }
}

#[test]
fn a_class_that_is_true_and_never_predicted_has_no_precision_for_that_reason() {
    let mut slip = Classes::new(["no_slip", "slip"], Some("slip")).expect("names");
    for truth in ["no_slip", "slip"] {
        slip.push("stroke", truth, "no_slip").expect("names");
    }
    let scores = slip.scores();
    assert_eq!(
        value(&scores, "precision", None),
        Err(Undefined::NoPrediction)
    );
    assert_eq!(value(&scores, "recall", None), Ok(0.0));
}
