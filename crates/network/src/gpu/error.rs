//! Errors of finding a GPU.

use crate::gpu::GpuKind;

/// Error of finding a GPU.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// The program was built without the feature of this kind.
    #[error(
        "this program was built without the feature `{kind}`: build it with `--features {kind}`, or train with `device=cpu`"
    )]
    NotBuilt {
        /// Requested kind, also the name of the feature.
        kind: GpuKind,
    },
    /// No device of this kind was found.
    #[error("no device for `{kind}`: looked for {looked_for}; {found}")]
    NotFound {
        /// Requested kind.
        kind: GpuKind,
        /// Requirements of this kind.
        looked_for: &'static str,
        /// Devices found in the search, or the reason for finding none.
        found: String,
    },
}
