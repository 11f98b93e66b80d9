//! What is refused of a grid before any work.

use std::collections::{BTreeMap, BTreeSet};

use taceva_models::{ChosenModel, Models};
use taceva_study::StudyError;

use super::Grid;
use crate::error::SweepError;
use crate::file::{ModelEntry, SweepFile};
use crate::limits::MOST_TASKS;

/// Refuses a grid without a task, or with too many.
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
    let counts: Vec<(&str, usize)> = counts.into_iter().chain(vary).collect();
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
                "a grid of {count} tasks ({}), {MOST_TASKS} are the most: vary less, or make several sweeps",
                parts.join(" × ")
            ),
        });
    }
    Ok(())
}

/// Refuses a model that is named twice with the same settings, and conditions over words that no task has.
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
        let problem =
            "`seed` varies by `seeds`, which divide the samples and are what models draw by";
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

/// Refuses a model or a setting that does not exist, before any work: each configuration once.
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

/// The build of the plugin behind each model that one offers. A model that does not exist has none, and is refused with its settings.
pub(super) fn builds(
    file: &SweepFile,
    models: &Models,
) -> Result<BTreeMap<String, String>, SweepError> {
    let mut builds = BTreeMap::new();
    for model in &file.models {
        if let Some(build) = build_of(&model.name, models)? {
            builds.insert(model.name.clone(), build);
        }
    }
    Ok(builds)
}

/// The build of the plugin that offers the model called `name`; none where it is built in, or not there.
///
/// # Errors
/// [`SweepError`] if the plugin cannot be read.
pub(crate) fn build_of(name: &str, models: &Models) -> Result<Option<String>, SweepError> {
    match models.find(name) {
        Ok(ChosenModel::Offered(factory)) => Ok(factory.build().map_err(StudyError::from)?),
        _ => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use taceva_core::{DriverKey, EstimatorFactory, FitRequest, ModelError, SavedRegressor};

    use super::*;

    /// A plugin's model of which nothing but the build is asked.
    struct Built(DriverKey, &'static str);

    impl EstimatorFactory for Built {
        fn key(&self) -> &DriverKey {
            &self.0
        }

        fn title(&self) -> &str {
            "built"
        }

        fn fit(&self, _request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
            panic!("nothing is fitted")
        }

        fn load(
            &self,
            _saved: &taceva_core::Saved<'_>,
        ) -> Result<Box<dyn SavedRegressor>, ModelError> {
            panic!("nothing is loaded")
        }

        fn build(&self) -> Result<Option<String>, ModelError> {
            Ok(Some(self.1.to_owned()))
        }
    }

    #[test]
    fn the_build_of_a_plugin_is_known_and_models_that_are_built_in_have_none() {
        let with = |build| {
            let key = "org.example/deep".parse().expect("a key");
            let factory: Arc<dyn EstimatorFactory> = Arc::new(Built(key, build));
            Models::builtin().with([factory])
        };
        let of = |name, build| build_of(name, &with(build)).expect("known");
        assert_eq!(
            of("org.example/deep", "sha256:1").as_deref(),
            Some("sha256:1")
        );
        assert_eq!(
            of("org.example/deep", "sha256:2").as_deref(),
            Some("sha256:2")
        );
        assert_eq!(of("ridge", "sha256:1"), None);
    }
}
