//! Values of published worked examples, recomputed.

mod conformity;
mod gauge;
mod quantiles;
mod support;
