//! From frames and signals to features.

mod area;
mod by_recording;
mod cell_features;
pub(crate) mod choice;
#[cfg(test)]
mod drawn;
mod error;
mod extractor;
mod gradients;
pub(crate) mod gratings;
mod kinds;
mod markers;
mod pca;
mod pixels;
mod preprocessing;
mod reduction;
mod seen;
pub(crate) mod signals;
mod spec;
mod statistics;

pub use by_recording::{FeaturesByRecording, RecordedFrames};
pub use error::FeatureError;
pub use extractor::Extractor;
pub use kinds::{FeatureKind, FeatureKinds};
pub use markers::{Marker, MarkerTracker, Polarity, Tracked};
pub use pca::Pca;
pub use preprocessing::Preprocessing;
pub use reduction::FrameReduction;
pub use spec::{Color, FeatureSpec};
pub(crate) use spec::{DIFFERENCE, SIZE};
