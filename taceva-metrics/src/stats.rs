//! Pure statistics behind the intervals.

pub(crate) mod jackknife;
mod student;
