//! What a power cut could leave of a real program's work.
//!
//! A program runs once under `strace`. Its system calls are replayed on a model of the disk that knows what is durable, and at
//! every moment all states are made that a cut could leave: changes that were not made durable kept, lost, torn or zero, names
//! of each folder up to any point. The caller puts each state on a real disk, recovers it, and reports whether a promise is broken.
//!
//! Killing a process cannot find a missing `fsync`, because the system keeps what was written; this can.

mod follower;
mod model;
mod operation;
mod remains;
mod seen;
mod states;
mod syscall;
mod trace;
mod tree;

pub use model::Disk;
pub use operation::{Kind, ObjectId, Operation, ROOT};
pub use states::{Counted, State};
pub use trace::{Trace, TraceError};
pub use tree::{Tree, read_tree, write_tree};
