//! Exit codes. Scripts rely on them.

/// The command succeeded.
pub(crate) const DONE: u8 = 0;
/// The command succeeded, but a limit or a check failed.
pub(crate) const CHECK_FAILED: u8 = 1;
/// The arguments are wrong.
pub(crate) const USAGE: u8 = 2;
/// A file, a row or a value is wrong.
pub(crate) const BAD_INPUT: u8 = 3;
/// A device failed; the run can be resumed.
pub(crate) const DEVICE: u8 = 4;
/// A signal stopped the command. Files that it wrote before are complete.
pub(crate) const STOPPED: u8 = 5;
/// An internal error.
pub(crate) const BUG: u8 = 70;
