//! Helpers shared by several suites: a plain network in double precision, a small training, convolutions by size.

pub(crate) mod plain;
pub(crate) mod small;
pub(crate) mod tiles;
