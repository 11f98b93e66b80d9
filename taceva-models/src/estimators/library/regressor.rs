//! Fitted models of other libraries, such as linfa and smartcore, with their features, parameters and scale of predictions.

use std::fmt;
use std::sync::Arc;

use rayon::prelude::*;
use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use super::answers::Fitted;
use super::task::{LibraryPredictor, LibrarySizes};
use super::tensor::{LibraryTensors, prefixed};
use super::{LibraryModel, library_models};
use crate::linalg::standard::Standard;
use crate::training::card::{Form, KindCard, LibraryCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{Raw, Tensors};
use crate::training::output::{OutputScale, check_call, check_finite};
use crate::training::regressor::{FittedModel, ModelRegressor};

/// A fitted model of another library.
#[derive(Clone)]
pub struct LibraryRegressor {
    card: LibraryCard,
    channels: Channels,
    shape: FeatureShape,
    standard: Standard,
    kept: Vec<usize>,
    live: Vec<usize>,
    scale: OutputScale,
    predictor: Option<Arc<dyn LibraryPredictor>>,
}

const CENTRE: &str = "library.centre";
const FACTOR: &str = "library.factor";
const KEPT: &str = "library.kept";
const LIVE: &str = "library.live";
const OFFSET: &str = "library.offset";
const SPAN: &str = "library.span";

impl LibraryRegressor {
    pub(super) fn new(
        card: LibraryCard,
        channels: Channels,
        shape: FeatureShape,
        scale: OutputScale,
        fitted: Fitted,
    ) -> LibraryRegressor {
        let own = scale.offset.iter().zip(&scale.span).zip(&fitted.base);
        LibraryRegressor {
            card,
            channels,
            shape,
            scale: OutputScale {
                offset: own
                    .map(|((offset, span), base)| offset + span * base)
                    .collect(),
                span: scale.span.clone(),
            },
            standard: fitted.standard,
            kept: fitted.kept,
            live: fitted.live,
            predictor: fitted.predictor.map(Arc::from),
        }
    }

    /// Entry of the model card: the library and release that fitted the model.
    pub fn card(&self) -> &LibraryCard {
        &self.card
    }

    /// Loads the model from a file. Fails if this build lacks the library of the model.
    pub(super) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        let card = stored.card.library.as_ref().ok_or(FormatError::Card)?;
        let model = library_models().find(|model| model.info.name == stored.card.model);
        let model = model.ok_or(FormatError::Card)?;
        stored.on_components(|tensors, channels, shape| {
            LibraryRegressor::from_tensors(tensors, channels, shape, model, card)
        })
    }

    /// Builds the model from the tensors of a file, with parameters read by `model`.
    fn from_tensors(
        tensors: &Tensors<'_>,
        channels: Channels,
        shape: FeatureShape,
        model: &LibraryModel,
        card: &LibraryCard,
    ) -> Result<LibraryRegressor, FormatError> {
        let (width, count) = (shape.len(), channels.len());
        let places = |name, below: usize| -> Result<Vec<usize>, FormatError> {
            let places = tensors.integers(name, &[tensors.rows(name)?])?;
            let places: Vec<usize> = places.into_iter().map(|place| place as usize).collect();
            let ascending = places.windows(2).all(|pair| pair[0] < pair[1]);
            if ascending && places.last().is_none_or(|last| *last < below) {
                Ok(places)
            } else {
                Err(FormatError::Card)
            }
        };
        let (kept, live) = (places(KEPT, width)?, places(LIVE, count)?);
        let scale = OutputScale {
            offset: tensors.doubles(OFFSET, &[count])?,
            span: tensors.doubles(SPAN, &[count])?,
        };
        if !scale.is_valid(count) || kept.is_empty() != live.is_empty() {
            return Err(FormatError::Card);
        }
        let sizes = LibrarySizes {
            samples: 0,
            features: kept.len(),
            targets: live.len(),
        };
        let predictor = match kept.is_empty() {
            true => None,
            false => Some((model.load)(&LibraryTensors(tensors), sizes)?.into()),
        };
        Ok(LibraryRegressor {
            card: card.clone(),
            standard: Standard::new(
                tensors.doubles(CENTRE, &[width])?,
                tensors.doubles(FACTOR, &[width])?,
            )?,
            channels,
            shape,
            kept,
            live,
            scale,
            predictor,
        })
    }

    fn write(&self, sample: &[f32], into: &mut [f64]) -> Result<(), ModelError> {
        into.copy_from_slice(&self.scale.offset);
        let Some(predictor) = &self.predictor else {
            return Ok(());
        };
        let mut own = vec![0.0; sample.len()];
        self.standard.write(sample, &mut own);
        let seen: Vec<f32> = self.kept.iter().map(|&feature| own[feature]).collect();
        let mut answers = vec![0.0; self.live.len()];
        predictor.predict(&seen, &mut answers)?;
        for (&channel, answer) in self.live.iter().zip(&answers) {
            into[channel] += self.scale.span[channel] * answer;
        }
        Ok(())
    }
}

impl FittedModel for LibraryRegressor {
    fn kind(&self) -> KindCard {
        KindCard {
            library: Some(self.card.clone()),
            ..KindCard::from(Form::Library)
        }
    }

    fn tensors(&self) -> Vec<Raw> {
        let (width, channels) = (self.shape.len(), self.channels.len());
        let places = |list: &[usize]| -> Vec<u32> {
            let places = list.iter();
            places
                .map(|&place| u32::try_from(place).expect("fewer than a file holds"))
                .collect()
        };
        let own = [
            Raw::doubles(CENTRE, vec![width], self.standard.centre()),
            Raw::doubles(FACTOR, vec![width], self.standard.factor()),
            Raw::integers(KEPT, vec![self.kept.len()], &places(&self.kept)),
            Raw::integers(LIVE, vec![self.live.len()], &places(&self.live)),
            Raw::doubles(OFFSET, vec![channels], &self.scale.offset),
            Raw::doubles(SPAN, vec![channels], &self.scale.span),
        ];
        let fitted = self.predictor.iter().flat_map(|fitted| fitted.tensors());
        own.into_iter().chain(fitted.map(prefixed)).collect()
    }

    fn reads_features(&self) -> bool {
        self.predictor.is_some()
    }
}

impl Regressor for LibraryRegressor {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(&self.channels, self.shape, features, into)?;
        into.par_chunks_mut(self.channels.len())
            .zip(features.values().par_chunks(self.shape.len()))
            .try_for_each(|(into, sample)| self.write(sample, into))?;
        check_finite(&self.channels, into)
    }
}

impl fmt::Debug for LibraryRegressor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LibraryRegressor")
            .field("card", &self.card)
            .field("features", &self.kept.len())
            .finish_non_exhaustive()
    }
}
