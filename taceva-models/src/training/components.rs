//! Regressors that read principal components, for models whose weights cannot be converted to weights of features.

use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use crate::features::Pca;
use crate::training::card::KindCard;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{Raw, Tensors};
use crate::training::output::check_call;
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Principal components, and a regressor that reads a sample projected onto them.
#[derive(Debug)]
pub(crate) struct ProjectedRegressor {
    pca: Pca,
    inner: ModelRegressor,
}

const COMPONENTS: &str = "pca.components";
const MEAN: &str = "pca.mean";
const RATIO: &str = "pca.variance_ratio";

impl ProjectedRegressor {
    pub(crate) fn new(pca: Pca, inner: ModelRegressor) -> ProjectedRegressor {
        ProjectedRegressor { pca, inner }
    }

    /// Reads `count` principal components of features of `shape` from a model file.
    pub(crate) fn pca_from(
        tensors: &Tensors<'_>,
        shape: FeatureShape,
        count: usize,
    ) -> Result<Pca, FormatError> {
        let width = shape.len();
        Ok(Pca::ready(
            shape,
            tensors.doubles(MEAN, &[width])?,
            tensors.doubles(COMPONENTS, &[count, width])?,
            tensors.doubles(RATIO, &[count])?,
        )?)
    }
}

impl FittedModel for ProjectedRegressor {
    fn kind(&self) -> KindCard {
        self.inner.kind()
    }

    fn tensors(&self) -> Vec<Raw> {
        let (count, width) = (self.pca.variance_ratio().len(), self.pca.mean().len());
        let components: Vec<f64> = self.pca.components().flatten().copied().collect();
        let own = [
            Raw::doubles(COMPONENTS, vec![count, width], &components),
            Raw::doubles(MEAN, vec![width], self.pca.mean()),
            Raw::doubles(RATIO, vec![count], self.pca.variance_ratio()),
        ];
        own.into_iter().chain(self.inner.tensors()).collect()
    }

    fn reads_features(&self) -> bool {
        self.inner.reads_features()
    }

    fn knows_deviations(&self) -> bool {
        self.inner.knows_deviations()
    }

    fn deviations(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        self.inner.deviations(&self.pca.transform(features)?)
    }
}

impl Regressor for ProjectedRegressor {
    fn channels(&self) -> &Channels {
        self.inner.channels()
    }

    fn shape(&self) -> FeatureShape {
        self.pca.shape()
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(self.channels(), self.shape(), features, into)?;
        self.inner.predict(&self.pca.transform(features)?, into)
    }
}
