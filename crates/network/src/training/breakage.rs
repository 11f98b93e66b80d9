//! Detection of numbers that became infinite or NaN in a training.

use serde::{Deserialize, Serialize};

use crate::error::NetworkError;

/// Location of the first number that is not finite. The training cannot continue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Breakage {
    /// Loss of this step, counted from 0.
    Loss(u64),
    /// Weight or running moment after this step, counted from 0.
    Weight(u64),
}

impl Breakage {
    /// Breakage that `error` reports; `None` for other errors.
    pub(super) fn of(error: &NetworkError) -> Option<Breakage> {
        match error {
            NetworkError::LossNotFinite { step } => Some(Breakage::Loss(*step)),
            NetworkError::WeightNotFinite { step } => Some(Breakage::Weight(*step)),
            _ => None,
        }
    }
}

impl From<Breakage> for NetworkError {
    fn from(breakage: Breakage) -> NetworkError {
        match breakage {
            Breakage::Loss(step) => NetworkError::LossNotFinite { step },
            Breakage::Weight(step) => NetworkError::WeightNotFinite { step },
        }
    }
}
