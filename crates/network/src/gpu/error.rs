//! Errors of the search for a GPU.

use crate::gpu::GpuKind;

/// Error of the search for a GPU.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// The program was built without the feature of this kind.
    #[error(
        "this program was built without the feature `{kind}`: build it with `--features {kind}`, or train with `device=cpu`"
    )]
    NotBuilt {
        /// Requested kind, which is also the name of the feature.
        kind: GpuKind,
    },
    /// No device of this kind was found.
    #[error("no device for `{kind}`: looked for {looked_for}; {found}")]
    NotFound {
        /// Requested kind.
        kind: GpuKind,
        /// Requirements for a device of this kind.
        looked_for: &'static str,
        /// Devices that the search found, or the reason why it found none.
        found: String,
    },
}
