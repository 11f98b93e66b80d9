//! Linear discriminants: the prediction for each channel is one of its training labels.

mod classes;
mod regressor;
mod scatter;

use std::ops::Range;

use rayon::prelude::*;
use taceva_core::{Channel, ModelError, Progress, TrainingSet};

pub use self::classes::Discriminant;
pub use self::regressor::ClassRegressor;
use self::regressor::Planes;
use crate::features::FeatureSpec;
use crate::linalg::invalid;
use crate::linalg::progress::{ReportedStage, interrupted};
use crate::linalg::{Design, FeatureScale};
use crate::settings::{ModelSettings, SettingError};
use crate::training::choice::{Choice, errors};
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::problem::Problem;
use crate::training::regressor::ModelRegressor;

/// Linear discriminants: the prediction for each channel is one of its training labels. Features are whitened by the covariance of samples within
/// labels. The predicted label has the nearest mean of features ([`Discriminant`]).
///
/// Suitable for channels with few distinct labels, such as the spacing of a grating. A channel with more than 256 labels is rejected. No setting is
/// chosen, so the validation part only serves to compute an error.
///
/// # Reference
/// R. A. Fisher, Ann. Eugen. 7 (1936) 179; O. Ledoit, M. Wolf, J. Multivar. Anal. 88 (2004) 365, eqs. 9-14.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LinearDiscriminant {
    scale: FeatureScale,
}

/// Maximum number of distinct labels of a channel.
pub(crate) const VALUES_MAX: usize = 256;

/// Maximum number of features of a covariance matrix, which then takes 134 MB.
const FEATURES_MAX: usize = 4096;

impl LinearDiscriminant {
    /// Registry entry of the model of linear discriminants.
    pub const INFO: ModelInfo = ModelInfo {
        name: "lda",
        about: "linear discriminants: predicts one of the labels of the training part, for kinds, boards and levels",
        settings: &[FeatureScale::SETTING],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(LinearDiscriminant::from_settings(settings)?)),
        load: ClassRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<LinearDiscriminant, SettingError> {
        settings.check_keys(LinearDiscriminant::INFO.settings)?;
        Ok(LinearDiscriminant {
            scale: FeatureScale::from_settings(settings)?,
        })
    }
}

/// Distinct labels of one channel, and for each sample the index of its label.
struct Levels {
    /// Distinct labels, ascending.
    values: Vec<f64>,
    classes: Vec<usize>,
}

impl Levels {
    fn of(training: &TrainingSet<'_>, position: usize) -> Result<Levels, ModelError> {
        let channels = training.targets.channels.as_slice();
        let labels = training.targets.values.iter().skip(position);
        let labels: Vec<f64> = labels.step_by(channels.len()).copied().collect();
        let mut values = labels.clone();
        values.sort_by(f64::total_cmp);
        values.dedup_by(|a, b| a.total_cmp(b).is_eq());
        if values.len() > VALUES_MAX {
            return Err(too_many(&channels[position], values.len()));
        }
        let class = |label: &f64| values.partition_point(|value| value.total_cmp(label).is_lt());
        Ok(Levels {
            classes: labels.iter().map(class).collect(),
            values,
        })
    }
}

fn too_many(channel: &Channel, values: usize) -> ModelError {
    invalid(format!(
        "`{channel}` has {values} values in the training part, discriminants accept at most {VALUES_MAX} classes: for continuous labels \
            choose another model, such as ridge"
    ))
}

impl ModelEstimator for LinearDiscriminant {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        let width = training.features.shape().len();
        if width > FEATURES_MAX {
            return Err(invalid(format!(
                "{width} features, discriminants accept at most {FEATURES_MAX}: set a smaller `size` or `pca`"
            )));
        }
        let design = Design::new(training.features, self.scale);
        let blocks = |samples: Range<usize>| design.block(samples, 0..width);
        let stage = ReportedStage::begin(progress, "channels", problem.channels());
        // Reports the error of the first failing channel, in any order of threads.
        let planes: Vec<Result<Planes, ModelError>> = (0..problem.channels())
            .into_par_iter()
            .map(|position| {
                interrupted(progress)?;
                let Levels { values, classes } = Levels::of(training, position)?;
                let discriminant = Discriminant::of_blocks(&blocks, &classes, progress)?;
                stage.advance();
                Ok(Planes::new(values, discriminant.planes(), &design))
            })
            .collect();
        drop(stage);
        let regressor = ClassRegressor::new(
            training.targets.channels.clone(),
            training.features.shape(),
            planes
                .into_iter()
                .collect::<Result<Vec<Planes>, ModelError>>()?,
        );
        let errors = match validation.filter(|_| held.is_some()) {
            Some(set) => errors(&regressor, set)?,
            None => vec![None; problem.channels()],
        };
        Ok(ModelFit {
            choice: Choice::nobodys(errors),
            regressor: ModelRegressor::new(regressor),
            refitted: false,
            scaling: problem.scaling,
        })
    }
}

estimator!(LinearDiscriminant, |_| LinearDiscriminant::INFO.name);
