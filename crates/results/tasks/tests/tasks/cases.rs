//! Golden cases of poses, maps, shapes and onsets, and comparison with them.

use serde_json::Value;
use taceva_tasks::TaskScore;

/// The golden case of `section` whose name begins with `name`.
pub(crate) fn case(section: &str, name: &str) -> Value {
    let file: Value =
        serde_json::from_str(include_str!("../golden/tasks.json")).expect("golden values");
    let cases = file[section].as_array().expect("a section of cases");
    let is_it = |case: &&Value| {
        case["name"]
            .as_str()
            .is_some_and(|text| text.starts_with(name))
    };
    cases.iter().find(is_it).expect("a case").clone()
}

/// The number `key` of a case.
pub(crate) fn number(case: &Value, key: &str) -> f64 {
    case[key]
        .as_f64()
        .unwrap_or_else(|| panic!("no number {key} in {case}"))
}

/// The list `key` of a case; null is NaN.
pub(crate) fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().expect("a list");
    list.iter()
        .map(|value| value.as_f64().unwrap_or(f64::NAN))
        .collect()
}

/// The points x, y, z of a list.
pub(crate) fn points(list: &Value) -> Vec<[f64; 3]> {
    let list = list.as_array().expect("a list");
    list.iter()
        .map(|point| numbers(point).try_into().expect("three coordinates"))
        .collect()
}

/// Fails if `found` is not within `relative` of `expected`.
pub(crate) fn close(found: f64, expected: f64, relative: f64, name: &str) {
    let off = (found - expected).abs();
    assert!(
        off <= relative * expected.abs(),
        "{name}: {found} is not {expected}"
    );
}

/// The score `metric` of `variant`.
pub(crate) fn score<'a>(
    scores: &'a [TaskScore],
    metric: &str,
    variant: Option<&str>,
) -> &'a TaskScore {
    scores
        .iter()
        .find(|score| score.metric == metric && score.variant.as_deref() == variant)
        .unwrap_or_else(|| panic!("no score {metric} {variant:?}"))
}

/// The value of the score `metric` of `variant`.
pub(crate) fn value(scores: &[TaskScore], metric: &str, variant: Option<&str>) -> f64 {
    score(scores, metric, variant)
        .estimate
        .value
        .unwrap_or_else(|reason| panic!("{metric} {variant:?}: {reason}"))
}
