//! Published worked examples, recomputed.

mod agreement;
mod budget;
mod conformity;
mod curve;
mod gauge;
mod metrics;
mod quantiles;
mod support;
mod tolerance;
