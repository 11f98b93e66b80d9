//! Values of published worked examples, recomputed.
