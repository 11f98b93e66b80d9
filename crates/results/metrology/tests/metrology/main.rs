//! Values of published worked examples, recomputed.

mod quantiles;
mod support;
