//! Helpers shared by several suites: a plain network in double precision, a small training, networks of 3 × 3 convolutions.

pub(crate) mod plain;
pub(crate) mod small;
pub(crate) mod tiles;
