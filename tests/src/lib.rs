//! Shared helpers of the cross-crate tests: the structure of the workspace, its built programs, real recordings if present, and simulated power cuts
//! of a program.

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
