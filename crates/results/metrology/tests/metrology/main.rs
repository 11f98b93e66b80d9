//! Values of published worked examples, recomputed.

mod budget;
mod curve;
