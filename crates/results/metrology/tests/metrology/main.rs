//! Values of published worked examples, recomputed.

mod gauge;
mod quantiles;
mod support;
