//! Tests of whole studies.

mod waiting;
