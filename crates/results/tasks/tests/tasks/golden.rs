//! Golden values: exact fractions, and scores of other libraries.

use serde_json::Value;
use taceva_tasks::{Classes, Probabilities, Ranking, TaskScore, Undefined};

/// Exact fractions and the scores of scikit-learn.
pub(crate) fn tasks() -> Value {
    serde_json::from_str(include_str!("../golden/tasks.json")).expect("JSON")
}

/// Scores of torchmetrics, in single precision.
pub(crate) fn torchmetrics() -> Value {
    serde_json::from_str(include_str!("../golden/tasks_torchmetrics.json")).expect("JSON")
}

/// Entries of the array `key`.
pub(crate) fn entries<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of[key]
        .as_array()
        .unwrap_or_else(|| panic!("no array {key}"))
}

/// Name of a golden data set.
pub(crate) fn name(of: &Value) -> &str {
    of["name"].as_str().expect("a name")
}

/// Numbers of the array `key`.
pub(crate) fn numbers(of: &Value, key: &str) -> Vec<f64> {
    let numbers = entries(of, key).iter();
    numbers
        .map(|number| number.as_f64().expect("a number"))
        .collect()
}

/// Whole numbers of the array `key`.
pub(crate) fn positions(of: &Value, key: &str) -> Vec<u32> {
    let positions = entries(of, key).iter();
    let position = |number: &Value| u32::try_from(number.as_u64()?).ok();
    positions
        .map(|number| position(number).expect("a position"))
        .collect()
}

/// Parses the key `fraction` of `of`, such as 2/3; `None` for null.
pub(crate) fn fraction(of: &Value) -> Option<f64> {
    let (above, below) = of["fraction"].as_str()?.split_once('/')?;
    let [above, below]: [f64; 2] = [above, below].map(|part| part.parse().expect("a number"));
    Some(above / below)
}

/// State of the labels of a set, all in one cluster.
pub(crate) fn classes(set: &Value) -> Classes {
    let names = positions(set, "labels");
    let names = names.iter().map(u32::to_string);
    let mut classes = Classes::new(names, None).expect("names");
    let pushed = classes.push_positions(
        "all",
        &positions(set, "truth"),
        &positions(set, "prediction"),
    );
    pushed.expect("labels");
    classes
}

/// True for each positive sample of a set.
pub(crate) fn is_positive(set: &Value) -> Vec<bool> {
    positions(set, "truth")
        .iter()
        .map(|truth| *truth == 1)
        .collect()
}

/// State of the scores of a set, all in one cluster.
pub(crate) fn ranking(set: &Value) -> Ranking {
    let mut ranking = Ranking::default();
    let pushed = ranking.push_rows("all", &numbers(set, "score"), &is_positive(set));
    pushed.expect("scores");
    ranking
}

/// State of a set's classes, predicted as positive if the score is above 0.5.
pub(crate) fn above_a_half(set: &Value) -> Classes {
    let mut classes = Classes::new(["negative", "positive"], Some("positive")).expect("names");
    let predicted: Vec<u32> = numbers(set, "score")
        .iter()
        .map(|score| u32::from(*score > 0.5))
        .collect();
    let pushed = classes.push_positions("all", &positions(set, "truth"), &predicted);
    pushed.expect("labels");
    classes
}

/// State of the scores of a set as probabilities of the positive class.
pub(crate) fn probabilities(set: &Value) -> Probabilities {
    let names = ["negative", "positive"];
    let mut probabilities = Probabilities::new(names, Some("positive")).expect("names");
    for (score, is_positive) in numbers(set, "score").into_iter().zip(is_positive(set)) {
        let truth = names[usize::from(is_positive)];
        let pushed = probabilities.push("all", truth, &[1.0 - score, score]);
        pushed.expect("two probabilities");
    }
    probabilities
}

/// The score of `metric` and `variant`.
pub(crate) fn score<'a>(
    scores: &'a [TaskScore],
    metric: &str,
    variant: Option<&str>,
) -> &'a TaskScore {
    let found = scores
        .iter()
        .find(|score| score.metric == metric && score.variant.as_deref() == variant);
    found.unwrap_or_else(|| panic!("no {metric} {variant:?}"))
}

/// Value of the score with this `metric` and `variant`.
pub(crate) fn value(
    scores: &[TaskScore],
    metric: &str,
    variant: Option<&str>,
) -> Result<f64, Undefined> {
    score(scores, metric, variant).estimate.value
}

/// Fails unless both are the same number to the bit, or both are missing.
pub(crate) fn same(found: Option<f64>, expected: Option<f64>, of: &str) {
    let bits = |value: Option<f64>| value.map(f64::to_bits);
    assert_eq!(
        bits(found),
        bits(expected),
        "{of}: {found:?}, not {expected:?}"
    );
}
