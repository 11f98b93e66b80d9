//! Values of published worked examples, recomputed.

mod agreement;
mod conformity;
mod gauge;
mod quantiles;
mod support;
mod tolerance;
