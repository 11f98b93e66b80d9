//! Where pictures meet the processor: arithmetic on four numbers at once, and the widest vectors there are.

mod lanes;
mod widest;

pub(super) use lanes::Lanes;
pub(super) use widest::expose;
