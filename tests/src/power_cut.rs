//! Possible states of a real program's files after a power cut.
//!
//! A program runs once under `strace`. Its system calls are replayed on a model of the disk that knows which changes are durable. At every moment,
//! all states that a power cut could leave are generated. A change that is not durable is kept, lost, partly written, or replaced by zeros. The names
//! in each folder exist up to any point in their order. The caller writes each state to a real disk, recovers it, and reports a broken promise.
//!
//! Killing a process cannot reveal a missing `fsync`, because the system keeps written data; this test can.

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
