//! How the last pictures become features.

use serde::{Deserialize, Serialize};

use crate::picture::Picture;

/// How the last pictures become features.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pooling {
    /// The mean of each channel over the pixels.
    Average,
    /// Every number of every pixel, `[height, width, channels]`.
    Flatten,
}

impl Pooling {
    /// Features of a picture.
    pub(crate) const fn features(self, picture: Picture) -> usize {
        match self {
            Pooling::Average => picture.channels,
            Pooling::Flatten => picture.len(),
        }
    }
}
