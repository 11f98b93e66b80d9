#![doc = include_str!("../README.md")]

mod id;
mod manifest;
mod session;
mod shown;

pub use id::{PluginId, PluginIdError};
pub use manifest::{
    AbiVersion, EstimatorInfo, LibraryFile, Manifest, ManifestError, Need, NeedError, Provided,
    Sha256Digest, UsbId, platform,
};
pub use session::{FitRequest, Saved, SavedRegressor, Session};
