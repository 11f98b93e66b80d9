//! From frames to features.

mod area;
mod extractor;
mod pca;
mod spec;

pub use extractor::{Extractor, FeatureError};
pub use pca::Pca;
pub use spec::{Color, FeatureSpec};
