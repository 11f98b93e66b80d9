//! SIMD arithmetic: lanes of four numbers, and dispatch to the widest vectors of the processor.

mod lanes;
mod widest;

pub(super) use lanes::Lanes;
pub(super) use widest::expose;
