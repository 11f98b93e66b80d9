//! Estimators and fitted models, one file or folder each.

pub(crate) mod auto;
pub(crate) mod baseline;
pub(crate) mod discriminant;
pub(crate) mod elastic_net;
pub(crate) mod kernel;
#[cfg_attr(
    not(any(feature = "linfa", feature = "smartcore")),
    allow(dead_code, reason = "only the adapters of libraries use it")
)]
pub(crate) mod library;
pub(crate) mod linear;
pub(crate) mod neighbours;
pub(crate) mod network;
pub(crate) mod pls;
pub(crate) mod plugin;
pub(crate) mod registry;
pub(crate) mod ridge;
pub(crate) mod trees;
