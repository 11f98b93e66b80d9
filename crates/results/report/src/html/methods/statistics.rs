//! Sentences of the methods paragraph on intervals, tests, and standing.

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::counted;
use taceva_metrics::{Standing, catalogue};

use crate::names::listed;
use crate::results::Study;
use crate::scores::ScoreTable;
use taceva_results::Score;

/// Sentences on intervals, tests and adjustment.
pub(super) fn statistics(studies: &[Study], table: &ScoreTable) -> String {
    let methods: BTreeSet<String> = table
        .rows
        .iter()
        .flat_map(|row| row.cells.iter().flatten())
        .filter_map(|cell| cell.method.as_deref())
        .map(without_count)
        .collect();
    let methods: Vec<String> = methods.into_iter().collect();
    let mut out = match methods.is_empty() {
        true => String::new(),
        false => format!(" Intervals are of 95 % ({}).", methods.join("; ")),
    };
    let mut tests: BTreeMap<String, usize> = BTreeMap::new();
    let answers = table.answers.iter();
    for difference in answers.filter_map(|answer| answer.difference.as_ref()) {
        *tests.entry(difference.test.to_string()).or_default() += 1;
    }
    if studies.len() > 1 && !tests.is_empty() {
        let tests = tests.into_iter();
        let tests: Vec<String> = tests
            .map(|(test, count)| format!("{test}: {}", counted(count, "pair")))
            .collect();
        out += &format!(
            " Sensors were compared pair by pair ({}) at a level of 5 %. Holm's method adjusts the p values over all pairs and channels of a metric.",
            tests.join("; ")
        );
    }
    out += &skill(studies);
    out + &seeds(studies)
}

/// Method of an interval without the seed and the numbers of clusters and replicates: `jackknife by point_id, logarithmic`.
fn without_count(method: &str) -> String {
    let is_kept = |part: &&str| {
        let is_count = ["G=", "B=", "seed="]
            .iter()
            .any(|count| part.starts_with(count));
        !is_count
    };
    let parts: Vec<&str> = method.split(", ").filter(is_kept).collect();
    parts.join(", ")
}

/// Sentence on compared scores, and on the marks of scores that are not compared.
fn skill(studies: &[Study]) -> String {
    let is_predicted = |score: &Score| {
        catalogue::find(&score.metric).is_some_and(|metric| metric.reads_predictions())
    };
    let mut scores = studies.iter().flat_map(|study| &study.scores);
    if !scores.any(is_predicted) {
        return String::new();
    }
    let marks: BTreeSet<Standing> = studies
        .iter()
        .flat_map(|study| &study.scores)
        .filter(|score| score.value.number().is_some() && !score.standing.takes_part())
        .map(|score| score.standing)
        .collect();
    let marks: Vec<String> = marks.into_iter().filter_map(explained).collect();
    let marked = match marks.is_empty() {
        true => "No score here is excluded".to_owned(),
        false => format!(
            "The others keep their values, are marked {} and are excluded from comparisons",
            listed(&marks)
        ),
    };
    format!(
        " Scores of predictions are compared only where the model has skill on each channel of the score. It has skill if the lower end of the 95 % interval of 1 − MSE(model) / MSE(constant), on samples that it had not seen, exceeds zero. For success rates (sr, and tolerance if the constant is known), the interval must also lie above the rate of a constant answer. {marked}."
    )
}

/// Standing with its meaning: `“not better than predicting the mean” (the skill of the model is not shown to be above zero)`.
fn explained(standing: Standing) -> Option<String> {
    let (mark, reason) = standing.reason()?.split_once(": ")?;
    Some(format!("“{mark}” ({reason})"))
}

/// Sentence on the training seeds of models that were fitted with several seeds.
fn seeds(studies: &[Study]) -> String {
    let over = studies.iter().filter_map(|study| study.over_seeds.as_ref());
    let mut all: Vec<Vec<String>> = over
        .map(|over| over.seeds.iter().map(ToString::to_string).collect())
        .collect();
    all.dedup();
    match all.as_slice() {
        [] => String::new(),
        [seeds] => format!(
            " Each model was fitted with the seeds {}. Scores are those of the first seed; the standard deviation over seeds is given separately. Tests of predictions add its square to the variance between clusters.",
            listed(seeds)
        ),
        _ => " Each model was fitted with several seeds. Scores are those of the first seed; the standard deviation over seeds is given separately. Tests of predictions add its square to the variance between clusters.".to_owned(),
    }
}
