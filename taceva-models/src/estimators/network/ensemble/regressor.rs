//! Fitted ensembles of networks.

use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};
use taceva_network::NamedTensor;

use super::super::NO_PICTURE;
use super::super::regressor::{NetworkRegressor, named_tensors};
use crate::features::Pca;
use crate::linalg::invalid;
use crate::training::card::KindCard;
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::Raw;
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Maximum number of members of an ensemble.
pub(super) const MEMBERS_MOST: usize = 16;

/// Fitted networks of one ensemble. Predictions are averaged over the networks.
#[derive(Clone, Debug)]
pub struct EnsembleRegressor {
    members: Vec<NetworkRegressor>,
}

impl EnsembleRegressor {
    /// Builds an ensemble from its fitted networks.
    ///
    /// # Errors
    /// [`ModelError`] if the number of networks is out of range, or if channels or features of the networks differ.
    pub(crate) fn new(members: Vec<NetworkRegressor>) -> Result<EnsembleRegressor, ModelError> {
        let is_like = |other: &NetworkRegressor| {
            let first = &members[0];
            other.channels() == first.channels() && other.shape() == first.shape()
        };
        if !(2..=MEMBERS_MOST).contains(&members.len()) || !members.iter().all(is_like) {
            return Err(invalid(format!(
                "an ensemble of {} networks, expected 2 to {MEMBERS_MOST} with the same channels and features",
                members.len()
            )));
        }
        Ok(EnsembleRegressor { members })
    }

    /// Loads the networks of an ensemble from a file. The tensor names of each network have a prefix of their own.
    pub(super) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        let mut found = named_tensors(&stored.tensors)?;
        let mut members = Vec::new();
        for (number, network) in stored.card.ensemble.iter().enumerate() {
            let prefix = prefix(number);
            let (own, others): (Vec<_>, Vec<_>) = found
                .into_iter()
                .partition(|tensor| tensor.name.starts_with(&prefix));
            found = others;
            let own = own.into_iter().map(|tensor| NamedTensor {
                name: tensor.name[prefix.len()..].to_owned(),
                ..tensor
            });
            let own = own.collect();
            members.push(NetworkRegressor::of_tensors(
                stored,
                stored.channels.clone(),
                network,
                own,
            )?);
        }
        match found.into_iter().next() {
            Some(tensor) => Err(FormatError::Unexpected { name: tensor.name }),
            None => Ok(ModelRegressor::new(EnsembleRegressor::new(members)?)),
        }
    }
}

/// Prefix of the tensor names of the network with index `member`.
fn prefix(member: usize) -> String {
    format!("member{member}.")
}

impl FittedModel for EnsembleRegressor {
    fn kind(&self) -> KindCard {
        let members = self.members.iter();
        KindCard {
            ensemble: members.map(|member| member.card().clone()).collect(),
            ..KindCard::default()
        }
    }

    fn tensors(&self) -> Vec<Raw> {
        let of = |(number, member): (usize, &NetworkRegressor)| {
            let prefix = prefix(number);
            let tensors = FittedModel::tensors(member).into_iter();
            let named = tensors.map(move |tensor| Raw {
                name: format!("{prefix}{}", tensor.name),
                ..tensor
            });
            named.collect::<Vec<Raw>>()
        };
        self.members.iter().enumerate().flat_map(of).collect()
    }

    fn reads_features(&self) -> bool {
        self.members.iter().any(NetworkRegressor::reads_features)
    }

    fn through(&self, _: &Pca) -> Result<Option<ModelRegressor>, ModelError> {
        Err(invalid(NO_PICTURE))
    }
}

impl Regressor for EnsembleRegressor {
    fn channels(&self) -> &Channels {
        self.members[0].channels()
    }

    fn shape(&self) -> FeatureShape {
        self.members[0].shape()
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        let mut own = vec![0.0; into.len()];
        let count = self.members.len() as f64;
        self.members[0].predict(features, into)?;
        for member in &self.members[1..] {
            member.predict(features, &mut own)?;
            for (sum, value) in into.iter_mut().zip(&own) {
                *sum += value;
            }
        }
        // Copies equal predictions without rounding: channels with constant labels.
        for (position, sum) in into.iter_mut().enumerate() {
            let channel = position % self.channels().len();
            if self.members[0].card().constant[channel].is_none() {
                *sum /= count;
            } else {
                *sum = own[position];
            }
        }
        Ok(())
    }
}
