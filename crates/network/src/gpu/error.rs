//! Why there is no GPU to train on.

use crate::gpu::GpuKind;

/// Why there is no GPU to train on.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// The program was built without the feature for that kind.
    #[error(
        "this program was built without the feature `{kind}`: build it with `--features {kind}`, or train with `device=cpu`"
    )]
    NotBuilt {
        /// What was asked for; the feature has its name.
        kind: GpuKind,
    },
    /// No device of that kind was found.
    #[error("no device for `{kind}`: looked for {looked_for}; {found}")]
    NotFound {
        /// What was asked for.
        kind: GpuKind,
        /// What is needed.
        looked_for: &'static str,
        /// What was found instead.
        found: String,
    },
}
