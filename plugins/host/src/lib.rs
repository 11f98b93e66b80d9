#![doc = include_str!("../README.md")]

mod call;
#[cfg(target_os = "linux")]
mod child;
mod config;
mod descriptor;
mod device;
mod estimator;
#[cfg(target_os = "linux")]
mod examination;
mod grant;
mod host;
mod id;
mod in_process;
mod library;
mod log;
mod manifest;
mod offer;
mod package;
mod python;
mod sealed_memory;
mod search;
mod session;
mod text;
mod usb;
mod wire_version;

pub use call::Failure;
#[cfg(target_os = "linux")]
pub use child::{
    CHILD_ARGUMENT, Child, ChildError, ChildSession, ChildSpec, Confinement, Examiner, Fate,
    Isolation, ModuleToImport, Patience, Quarantine, Quarantined, main_if_child,
    main_if_child_examining, main_if_child_with, serve_as_child,
};
// Only for fuzzing.
#[cfg(target_os = "linux")]
#[doc(hidden)]
pub use child::read_any_message;
pub use config::{ConfigError, Delivery, PluginConfig, Trust};
pub use device::{LentFrame, PluginSensor};
#[cfg(target_os = "linux")]
pub use examination::{Examination, ExaminationError, ExaminationOrder};
pub use grant::{NOT_ALLOWED, Withheld};
pub use host::{Children, Keeping, PluginDriver, PluginHost, PluginLog};
pub use id::{PluginId, PluginIdError};
pub use in_process::InProcess;
pub use library::{Image, Level, Library, Linked, LoadError, LoadProblem, Log, libraries_loaded};
pub use manifest::{
    AbiVersion, DeclaredNeed, EstimatorInfo, LibraryFile, Manifest, ManifestError, Need, NeedError,
    Profile, Provided, PythonModule, Sha256Digest, UsbId, platform,
};
pub use offer::Offer;
pub use package::{PackageError, pack, unpack};
pub use python::{Interpreter, PythonError, beside_this_program, run_within};
pub use search::{
    Code, NotFound, Place, Plugin, Plugins, Reason, ReasonKind, Rejection, SearchPath,
    user_config_file,
};
pub use session::{FitRequest, Saved, SavedRegressor, Session};
pub use wire_version::WIRE;

/// Loaded libraries and their function tables, for programs that examine plugins.
#[cfg(target_os = "linux")]
pub mod bare {
    pub use crate::call::pending_call::{self, UnderWay};
    pub use crate::call::{ArgList, Table, Taken, call, take, timeout};
    pub use crate::child::CALL;
    pub use crate::device::{Handle, Opened, Owned, RigHandle, open};
    pub use crate::library::{Entry, Source};
}
