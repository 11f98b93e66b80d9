//! What the cross-crate tests share: the workspace seen from outside, and the real recordings where they are present.

mod recordings;
mod workspace;

pub use recordings::recording;
pub use workspace::{metadata, read, root};
