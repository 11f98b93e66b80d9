//! Reduction of a network's last pictures to features.

use serde::{Deserialize, Serialize};

use crate::picture::Picture;

/// Reduction of a network's last pictures to features.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pooling {
    /// Mean of each channel over the pixels.
    Average,
    /// Every value of every pixel, shape `[height, width, channels]`.
    Flatten,
}

impl Pooling {
    /// Number of features of one picture.
    pub(crate) const fn features(self, picture: Picture) -> usize {
        match self {
            Pooling::Average => picture.channels,
            Pooling::Flatten => picture.len(),
        }
    }
}
