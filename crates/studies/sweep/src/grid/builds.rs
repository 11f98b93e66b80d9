//! Builds of the plugins that provide models. The keys of tasks include these builds.

use std::collections::BTreeMap;

use taceva_evaluate::EvaluateError;
use taceva_models::{ChosenModel, Models};

use crate::error::SweepError;
use crate::file::SweepFile;

/// Build of the plugin that provides each plugin model. Unknown models are skipped here, and rejected by the check of settings.
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

/// Build of the plugin that provides the model `name`; `None` if the model is built in or unknown.
///
/// # Errors
/// [`SweepError`] if the plugin cannot be read.
pub(crate) fn build_of(name: &str, models: &Models) -> Result<Option<String>, SweepError> {
    match models.find(name) {
        Ok(ChosenModel::Offered(factory)) => Ok(factory.build().map_err(EvaluateError::from)?),
        _ => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use taceva_core::{DriverKey, EstimatorFactory, FitRequest, ModelError, SavedRegressor};

    use super::*;

    /// Test double of a plugin model, with a fixed build.
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
