//! What the cross-crate tests share: the workspace seen from outside, its built programs, the real recordings where they are
//! present, and the means to cut the power of a program at any moment.

mod binary;
mod drawn;
mod random;
mod recordings;
mod workspace;

pub mod imports;
pub mod power_cut;
pub mod recorded;
pub mod renew;
pub mod source;
pub mod structure;
pub mod toy;
pub mod wire;

pub use binary::{example, library, taceva};
pub use drawn::{Form, Lab, picture, scratch};
pub use random::Random;
pub use recordings::recording;
pub use workspace::{metadata, read, root};
