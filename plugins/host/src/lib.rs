#![doc = include_str!("../README.md")]

mod call;
#[cfg(target_os = "linux")]
mod child;
mod descriptor;
mod device;
mod estimator;
mod id;
mod in_process;
mod library;
mod manifest;
mod session;
mod shown;

pub use call::Failure;
#[cfg(target_os = "linux")]
pub use child::{
    CHILD_ARGUMENT, Child, ChildError, ChildSession, ChildSpec, Confinement, Fate, Isolation,
    Patience, Quarantine, Quarantined, main_if_child, main_if_child_with,
};
pub use device::{LentFrame, PluginSensor};
pub use id::{PluginId, PluginIdError};
pub use in_process::InProcess;
pub use library::{Image, Level, Library, LoadError, LoadProblem, Log, libraries_loaded};
pub use manifest::{
    AbiVersion, EstimatorInfo, LibraryFile, Manifest, ManifestError, Need, NeedError, Provided,
    Sha256Digest, UsbId, platform,
};
pub use session::{FitRequest, Saved, SavedRegressor, Session};
