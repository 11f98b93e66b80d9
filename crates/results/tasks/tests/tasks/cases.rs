//! Golden cases of poses, maps, shapes and onsets, and comparison with them.

use serde_json::Value;
use taceva_tasks::TaskScore;

use super::golden;
pub(crate) use super::golden::score;

/// The golden case of `section` whose name begins with `name`.
pub(crate) fn case(section: &str, name: &str) -> Value {
    let file = golden::tasks();
    let mut cases = golden::entries(&file, section).iter();
    let found = cases.find(|case| golden::name(case).starts_with(name));
    found.expect("a case").clone()
}

/// The number `key` of a case.
pub(crate) fn number(case: &Value, key: &str) -> f64 {
    case[key]
        .as_f64()
        .unwrap_or_else(|| panic!("no number {key} in {case}"))
}

/// The numbers of a list; null is NaN.
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

/// Value of the score with this `metric` and `variant`.
pub(crate) fn value(scores: &[TaskScore], metric: &str, variant: Option<&str>) -> f64 {
    score(scores, metric, variant)
        .estimate
        .value
        .unwrap_or_else(|reason| panic!("{metric} {variant:?}: {reason}"))
}
