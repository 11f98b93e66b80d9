//! Algorithms (kernels) for MAE, R² and sMAPE, with inputs that expose their rounding errors. Requires the feature `bench`.
//!
//! Every [`Kernel`] reads two columns and returns three scores. A caller can measure the run time, count correct [`digits`], and check that
//! [`shuffled`] rows give the same scores. No code in this module reads a clock. The run time of [`stream_sum`], which only reads both columns, is
//! the lower bound of all run times.
//!
//! ```
//! use taceva_metrics::bench::{Kernel, digits, nasty_inputs, shuffled};
//! let (_, case) = nasty_inputs().find(|(name, _)| *name == "offset 1e9").expect("it is one of them");
//! let columns = case.columns();
//! let truth = Kernel::truth(columns.as_slices());
//! let naive = Kernel::Naive.run(columns.as_slices());
//! assert!(digits(naive.r2.unwrap_or(f64::INFINITY), truth.r2.expect("the truth varies")) < 3.0);
//! for kernel in Kernel::available().into_iter().filter(|kernel| kernel.is_order_free()) {
//!     let scores = kernel.run(columns.as_slices());
//!     assert_eq!(scores, truth);
//!     assert_eq!(kernel.run(shuffled(&columns, 7).as_slices()), scores);
//! }
//! ```

mod bandwidth;
mod case;
mod compensation;
mod digits;
mod kernel;
mod numbers;
mod permutation;
mod reference;
mod scores;
mod textbook;

pub use bandwidth::stream_sum;
pub use case::{Case, Kind, Order, nasty_inputs};
pub use digits::{ALL_DIGITS, digits};
pub use kernel::Kernel;
pub use permutation::shuffled;
pub use scores::Scores;
