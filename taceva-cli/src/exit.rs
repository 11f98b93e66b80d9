//! What the exit code says. Scripts rely on it.

/// Done.
pub(crate) const DONE: u8 = 0;
/// Done, but a limit or a check failed.
pub(crate) const CHECK_FAILED: u8 = 1;
/// The arguments cannot be meant.
pub(crate) const USAGE: u8 = 2;
/// A file, a row or a value is not what it should be.
pub(crate) const BAD_INPUT: u8 = 3;
/// A device failed; the run can be gone on with.
pub(crate) const DEVICE: u8 = 4;
/// Stopped by a signal; what was written before is whole.
pub(crate) const STOPPED: u8 = 5;
/// A bug of ours.
pub(crate) const BUG: u8 = 70;
