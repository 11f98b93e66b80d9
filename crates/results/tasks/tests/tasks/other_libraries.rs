//! Scores of scikit-learn and torchmetrics. They equal the scores of TacEva wherever both are defined, except for explained differences.

use crate::golden::{
    above_a_half, classes, entries, name, probabilities, ranking, score, tasks, torchmetrics, value,
};
use serde_json::Value;
use taceva_tasks::Undefined;

/// Greatest accepted difference from a library that computes in single precision.
const SINGLE: f64 = 1e-7;

/// A score of another library that differs from the score of TacEva.
#[derive(Debug, PartialEq)]
struct Difference {
    set: String,
    score: &'static str,
    ours: Option<f64>,
    theirs: Option<f64>,
}

impl Difference {
    /// The difference if it exceeds `within`, relative to `theirs` if that is above 1 in magnitude.
    fn beyond(
        within: f64,
        set: &Value,
        score: &'static str,
        ours: Option<f64>,
        theirs: &Value,
    ) -> Option<Difference> {
        let theirs = theirs.as_f64();
        let is_close = match (ours, theirs) {
            (Some(ours), Some(theirs)) => (ours - theirs).abs() <= within * theirs.abs().max(1.0),
            (ours, theirs) => ours == theirs,
        };
        (!is_close).then(|| Difference {
            set: name(set).to_owned(),
            score,
            ours,
            theirs,
        })
    }

    /// A score that the other library defines and TacEva does not.
    fn undefined(set: &str, score: &'static str, theirs: f64) -> Difference {
        Difference {
            set: set.to_owned(),
            score,
            ours: None,
            theirs: Some(theirs),
        }
    }
}

#[test]
fn scikit_learn_agrees_on_labels_but_where_one_class_leaves_no_correlation() {
    let golden = tasks();
    let mut differences = Vec::new();
    for set in entries(&golden, "classification") {
        let theirs = &set["sklearn"];
        let scores = classes(set).scores();
        for (key, metric, variant) in [
            ("accuracy", "class_accuracy", None),
            ("balanced_accuracy", "balanced_accuracy", None),
            ("macro_f1_default_labels", "f1_macro", None),
            ("macro_f1_all_labels", "f1_macro", Some("all_names")),
            ("weighted_f1", "f1_macro", Some("weighted")),
            ("micro_f1", "class_accuracy", None),
            ("kappa", "kappa", None),
            ("mcc", "mcc", None),
        ] {
            let ours = value(&scores, metric, variant).ok();
            differences.extend(Difference::beyond(1e-15, set, key, ours, &theirs[key]));
        }
        for (class, theirs) in entries(theirs, "f1_per_class").iter().enumerate() {
            let ours = value(&scores, "f1_macro", Some(&format!("class {class}"))).ok();
            differences.extend(Difference::beyond(1e-15, set, "f1_per_class", ours, theirs));
        }
    }
    // 0/0, which scikit-learn takes for 0.
    let one_class = [
        "one class only, all right",
        "one class only, one wrong",
        "constant prediction",
    ];
    let expected = one_class.map(|set| Difference::undefined(set, "mcc", 0.0));
    assert_eq!(differences, expected);
}

#[test]
fn scikit_learn_agrees_on_scores_but_where_no_sample_is_positive() {
    let golden = tasks();
    let mut differences = Vec::new();
    for set in entries(&golden, "binary") {
        let theirs = &set["sklearn"];
        let scores = [ranking(set).scores(), probabilities(set).scores()].concat();
        for key in ["roc_auc", "average_precision", "brier", "log_loss"] {
            let ours = value(&scores, key, None).ok();
            differences.extend(Difference::beyond(1e-15, set, key, ours, &theirs[key]));
        }
        let f1 = value(&above_a_half(set).scores(), "f1", None).ok();
        differences.extend(Difference::beyond(1e-15, set, "f1", f1, &theirs["f1"]));
    }
    // A recall of 0/0.
    let expected = [Difference::undefined(
        "no positive",
        "average_precision",
        0.0,
    )];
    assert_eq!(differences, expected);
}

#[test]
fn average_precision_is_not_the_area_under_straight_lines() {
    // A line between two points of the curve promises precisions that no threshold reaches.
    let golden = tasks();
    let ties = &entries(&golden, "binary")[1];
    let trapezoid = ties["sklearn"]["pr_auc_trapezoid"].as_f64();
    let ours = value(&ranking(ties).scores(), "average_precision", None);
    assert!(trapezoid.is_some_and(|area| area > 0.7964) && ours.is_ok_and(|ours| ours < 0.6929));
}

#[test]
fn a_class_that_nobody_names_lowers_a_mean_over_all_names_alone() {
    // scikit-learn counts such a class by `labels=`, and leaves it out by default.
    let golden = tasks();
    let set = &entries(&golden, "classification")[1];
    let scores = classes(set).scores();
    let [seen, all] = [None, Some("all_names")].map(|variant| value(&scores, "f1_macro", variant));
    assert_eq!((seen, all), (Ok(59.0 / 90.0), Ok(59.0 / 120.0)));
}

#[test]
fn a_class_that_is_predicted_and_never_true_lowers_a_mean_over_seen_classes_alone() {
    let golden = tasks();
    let set = &entries(&golden, "classification")[2];
    let scores = classes(set).scores();
    let [seen, true_] = [None, Some("in_truth")].map(|variant| value(&scores, "f1_macro", variant));
    assert_eq!((seen, true_), (Ok(8.0 / 15.0), Ok(0.8)));
}

#[test]
fn torchmetrics_counts_a_class_that_is_never_true_with_recall_0() {
    let golden = tasks();
    let mut differences = Vec::new();
    let theirs = torchmetrics();
    let sets = entries(&golden, "classification").iter();
    for (set, theirs) in sets.zip(entries(&theirs, "classification")) {
        assert_eq!(name(set), name(theirs));
        let scores = classes(set).scores();
        for (key, metric, variant) in [
            ("accuracy_micro", "class_accuracy", None),
            ("accuracy_macro(=balanced)", "balanced_accuracy", None),
            ("f1_macro", "f1_macro", None),
            ("f1_weighted", "f1_macro", Some("weighted")),
            ("kappa", "kappa", None),
            ("mcc", "mcc", None),
        ] {
            let ours = value(&scores, metric, variant).ok();
            differences.extend(Difference::beyond(SINGLE, set, key, ours, &theirs[key]));
        }
    }
    let balanced = |at: &Difference| at.score == "accuracy_macro(=balanced)";
    let (recalls, others): (Vec<Difference>, Vec<Difference>) =
        differences.into_iter().partition(balanced);
    // Recalls 2/3 and 2/3 of the classes in the truth, and 0/0 taken for 0: 4/9 in the place of 2/3. Recall 3/4 and 0/0: 3/8 for 3/4.
    let found: Vec<&str> = recalls.iter().map(|at| at.set.as_str()).collect();
    assert_eq!(
        found,
        ["class 2 predicted, never true", "one class only, one wrong"]
    );
    let expected = [[2.0 / 3.0, 4.0 / 9.0], [0.75, 0.375]];
    for (recall, [ours, theirs]) in recalls.iter().zip(expected) {
        assert_eq!(recall.ours, Some(ours));
        assert!(
            recall
                .theirs
                .is_some_and(|found| (found - theirs).abs() < SINGLE)
        );
    }
    // A correlation with a constant is 0/0: they say 1, and √(1/3), and 0.
    let found: Vec<(&str, &str, Option<f64>)> = others
        .iter()
        .map(|at| (at.set.as_str(), at.score, at.ours))
        .collect();
    let expected = [
        ("one class only, all right", "mcc", None),
        ("one class only, one wrong", "mcc", None),
        ("constant prediction", "mcc", None),
    ];
    assert_eq!(found, expected);
    let theirs: Vec<f64> = others.iter().filter_map(|at| at.theirs).collect();
    for (found, expected) in theirs.iter().zip([1.0, (1.0_f64 / 3.0).sqrt(), 0.0]) {
        assert!((found - expected).abs() < SINGLE, "{theirs:?}");
    }
}

#[test]
fn torchmetrics_gives_numbers_where_one_class_leaves_no_ranking() {
    let golden = tasks();
    let theirs = torchmetrics();
    let mut differences = Vec::new();
    let sets = entries(&golden, "binary").iter();
    for (set, theirs) in sets.zip(entries(&theirs, "binary")) {
        assert_eq!(name(set), name(theirs));
        let scores = ranking(set).scores();
        let [auc, precision] =
            ["roc_auc", "average_precision"].map(|metric| value(&scores, metric, None).ok());
        let f1 = value(&above_a_half(set).scores(), "f1", None).ok();
        for (key, ours) in [("auroc", auc), ("average_precision", precision), ("f1", f1)] {
            differences.extend(Difference::beyond(SINGLE, set, key, ours, &theirs[key]));
        }
    }
    let expected = [
        Difference::undefined("no positive", "auroc", 0.0),
        Difference::undefined("no positive", "average_precision", -0.0),
        Difference::undefined("no positive", "f1", 0.0),
        Difference::undefined("only positives", "auroc", 0.0),
    ];
    assert_eq!(differences, expected);
    let only = entries(&golden, "binary")
        .iter()
        .find(|set| name(set) == "only positives");
    let scores = ranking(only.expect("the set")).scores();
    assert_eq!(
        score(&scores, "roc_auc", None).estimate.value,
        Err(Undefined::OneClass)
    );
}
