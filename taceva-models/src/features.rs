//! Features: the numbers that a model reads, computed from frames or signals.

mod area;
mod cell_features;
pub(crate) mod choice;
mod error;
mod extractor;
mod feature_distance;
mod gradients;
pub(crate) mod gratings;
mod kinds;
mod markers;
mod pca;
mod pixels;
mod preprocessing;
mod recording_rules;
mod reduction;
pub(crate) mod signals;
mod source;
mod spec;
mod statistics;
#[cfg(test)]
mod test_pictures;
mod window;

pub use error::FeatureError;
pub use extractor::Extractor;
pub(crate) use feature_distance::DistanceLimits;
pub use feature_distance::FeatureDistance;
pub use kinds::{FeatureKind, FeatureKinds};
pub use markers::{Marker, MarkerTracker, Polarity, Tracked};
pub use pca::Pca;
pub use preprocessing::Preprocessing;
pub use recording_rules::{FeaturesByRecording, RecordedFrames};
pub use reduction::FrameReduction;
pub use spec::{Color, FeatureSpec};
pub(crate) use spec::{DIFFERENCE, SIZE};
pub use window::FrameWindow;
