//! Example results for tests: errors at eight contact points.

use std::collections::BTreeMap;

use taceva_core::Unit;
use taceva_dataset::Digest;
use taceva_results::Score;

use crate::analysis::Group;
use crate::key::{KeyParts, TaskKey};
use crate::result::{TaskResult, ValidationError};

/// Example result with a mean absolute error of `Fz` of `error`, in N.
pub(super) fn result(error: f64) -> TaskResult {
    let key = TaskKey::of(KeyParts {
        dataset: Digest::of(b"data"),
        model: "cnn",
        settings: &BTreeMap::new(),
        split: None,
        seed: 1,
        metrics: &[],
        sensor: None,
        plugin: None,
        labels: None,
    });
    let mut result = TaskResult::new(key);
    result
        .scores
        .push(Score::of_number("mae", "Fz", error, Unit::Newton));
    result.validation.push(ValidationError {
        channel: "Fz".to_owned(),
        unit: Unit::Newton,
        rmse: error,
    });
    let points = (0..8_u32).map(|point| (format!("p{point}"), 1, error * f64::from(point + 1)));
    result.errors.insert("Fz".to_owned(), points.collect());
    result
}

/// Example group: a configuration with a result for each of `seeds`.
pub(super) fn group<'a>(seeds: &[u64], results: &'a [TaskResult]) -> Group<'a> {
    Group {
        dataset: "monday",
        split: None,
        configuration: "cnn".to_owned(),
        results: seeds.iter().copied().zip(results).collect(),
        is_whole: true,
    }
}
