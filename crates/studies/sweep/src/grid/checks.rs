//! Checks of a grid before any task runs.

use std::collections::BTreeSet;

use taceva_core::shown;
use taceva_evaluate::EvaluateError;
use taceva_metrics::catalogue;
use taceva_models::{Models, Suggestion};
use taceva_tasks::TaskScore;

use super::Grid;
use crate::error::SweepError;
use crate::file::{ALL_METRICS, ModelEntry, SweepFile};
use crate::limits::MOST_TASKS;

/// Rejects a grid without tasks, or with too many.
pub(super) fn size(file: &SweepFile, recordings: usize) -> Result<(), SweepError> {
    let counts = [
        ("datasets", recordings),
        ("models", file.models.len()),
        ("seeds", file.seeds.len()),
        ("splits", file.splits.len()),
    ];
    let vary = file
        .vary
        .iter()
        .map(|(key, values)| (key.as_str(), values.len()));
    let labels = (!file.labels.is_empty()).then_some(("task", file.labels.len()));
    let counts: Vec<(&str, usize)> = counts.into_iter().chain(labels).chain(vary).collect();
    if let Some((key, _)) = counts.iter().find(|(_, count)| *count == 0) {
        return Err(file.wrong(
            key,
            format!("an empty grid: `{key}` has no entry; name at least one"),
        ));
    }
    let count = counts.iter().fold(1_u128, |product, (_, count)| {
        product.saturating_mul(*count as u128)
    });
    if count > u128::from(MOST_TASKS) {
        let parts: Vec<String> = counts
            .iter()
            .map(|(key, count)| format!("{count} {key}"))
            .collect();
        return Err(SweepError::Meaning {
            path: file.path.clone(),
            line: None,
            problem: format!(
                "a grid of {count} tasks ({}), expected at most {MOST_TASKS}: vary fewer settings, or write several sweeps",
                parts.join(" × ")
            ),
        });
    }
    Ok(())
}

/// Rejects an unknown metric, a metric of channels in a sweep over tasks, and a metric of tasks in a sweep over channels.
pub(super) fn metrics(file: &SweepFile) -> Result<(), SweepError> {
    let is_of_tasks = |name: &&String| TaskScore::METRICS.contains(&name.as_str());
    if file.labels.is_empty() {
        if let Some(name) = file.metrics.iter().find(is_of_tasks) {
            let problem = format!(
                "`metrics`: {name} is a score of tasks, and this sweep scores channels: write `task = \"NAME\"` with a task of the recordings; \
                 a file has either tasks or channels"
            );
            return Err(file.wrong("metrics", problem));
        }
        let metrics = file.metrics.iter().map(String::as_str);
        catalogue::select(metrics).map_err(EvaluateError::from)?;
        return Ok(());
    }
    let mut others = file.metrics.iter().filter(|name| *name != ALL_METRICS);
    let Some(name) = others.find(|name| !is_of_tasks(name)) else {
        return Ok(());
    };
    let problem = match catalogue::select([name.as_str()]) {
        Ok(_) => format!(
            "`metrics`: {name} applies to channels only, but `task` scores labels: write scores of tasks, such as `metrics = [\"f1_macro\"]`, and score \
             channels by a second file without `task`"
        ),
        Err(_) => format!(
            "`metrics`: {}: {}",
            shown(name),
            Suggestion::of(name, TaskScore::METRICS.iter().copied())
        ),
    };
    Err(file.wrong("metrics", problem))
}

/// Rejects a model that is listed twice with the same settings, and conditions on names that no task has.
pub(super) fn words(file: &SweepFile) -> Result<(), SweepError> {
    for (at, one) in file.models.iter().enumerate() {
        let is_alike = |other: &ModelEntry| other.name == one.name && other.set == one.set;
        if file.models[..at].iter().any(is_alike) {
            let problem = format!(
                "the model {} is named twice with the same settings",
                one.name
            );
            return Err(file.wrong("models", problem));
        }
    }
    if file.vary.contains_key("seed") {
        let problem = "vary the seed with `seeds`, which set both the split of samples and the random numbers of models";
        return Err(file.wrong("seed", problem.to_owned()));
    }
    let own = file.models.iter().flat_map(|model| model.set.keys());
    let settings: BTreeSet<String> = file.vary.keys().chain(own).cloned().collect();
    for condition in &file.skip {
        let known = condition.check_names(&settings);
        known.map_err(|error| file.wrong("where", error.to_string()))?;
    }
    Ok(())
}

/// Rejects an unknown model or setting before any task runs; checks each configuration once.
pub(super) fn settings(file: &SweepFile, grid: &Grid, models: &Models) -> Result<(), SweepError> {
    let mut checked = BTreeSet::new();
    for task in &grid.tasks {
        if !checked.insert(task.configuration()) {
            continue;
        }
        let valid = task.request(models).and_then(|request| request.check());
        valid.map_err(|error| {
            let named = task.settings.keys();
            let named = named.filter(|key| error.to_string().contains(key.as_str()));
            let key = named.max_by_key(|key| key.len()).unwrap_or(&task.model);
            file.wrong(
                key,
                format!(
                    "the model {} with {}: {error}; `[skip] where = [\"model = {}\"]` leaves combinations out",
                    task.model,
                    task.configuration(),
                    task.model
                ),
            )
        })?;
    }
    Ok(())
}
