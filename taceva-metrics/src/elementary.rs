//! Exponential and logarithm with the same bits on every machine.
//!
//! ```
//! use taceva_metrics::elementary::{exponential, logarithm};
//! assert_eq!((exponential(0.0), logarithm(1.0)), (1.0, 0.0));
//! assert!((logarithm(exponential(1.5)) - 1.5).abs() < 1e-15);
//! ```

mod exponential;
mod logarithm;

pub use exponential::exponential;
pub use logarithm::logarithm;
