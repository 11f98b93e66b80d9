//! Fitted networks whose predictions are averaged.

use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use super::super::{NetworkCard, NetworkRegressor};
use crate::linalg::invalid;
use crate::training::file::tensors::Raw;

/// The most members of an ensemble.
pub(super) const MEMBERS_MOST: usize = 16;

/// Fitted networks, from features to channels: the mean of what each predicts.
#[derive(Clone, Debug, PartialEq)]
pub struct EnsembleRegressor {
    members: Vec<NetworkRegressor>,
}

impl EnsembleRegressor {
    /// A regressor of ready networks.
    ///
    /// # Errors
    /// [`ModelError`] if they are fewer or more than an ensemble has, or of different channels or features.
    pub(crate) fn new(members: Vec<NetworkRegressor>) -> Result<EnsembleRegressor, ModelError> {
        let is_like = |other: &NetworkRegressor| {
            let first = &members[0];
            other.channels() == first.channels() && other.shape() == first.shape()
        };
        if !(2..=MEMBERS_MOST).contains(&members.len()) || !members.iter().all(is_like) {
            return Err(invalid(format!(
                "an ensemble of {} networks: 2 to {MEMBERS_MOST} of the same channels and features are expected",
                members.len()
            )));
        }
        Ok(EnsembleRegressor { members })
    }

    /// What a file says of each network.
    pub fn cards(&self) -> Vec<NetworkCard> {
        let members = self.members.iter();
        members.map(|member| member.card().clone()).collect()
    }

    /// How tensors of the member are called.
    pub(crate) fn prefix(member: usize) -> String {
        format!("member{member}.")
    }

    pub(crate) fn tensors(&self) -> Vec<Raw> {
        let of = |(number, member): (usize, &NetworkRegressor)| {
            let prefix = EnsembleRegressor::prefix(number);
            let tensors = member.tensors().into_iter();
            let named = tensors.map(move |tensor| {
                let name = format!("{prefix}{}", tensor.name);
                Raw::singles(&name, tensor.shape, &tensor.values)
            });
            named.collect::<Vec<Raw>>()
        };
        self.members.iter().enumerate().flat_map(of).collect()
    }

    /// Whether any channel is predicted from what is seen.
    pub(crate) fn reads_features(&self) -> bool {
        self.members.iter().any(NetworkRegressor::reads_features)
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
        // What all members predict is predicted to the last bit: a channel whose labels are all the same.
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
