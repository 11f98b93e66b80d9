//! Whole studies.

mod waiting;
