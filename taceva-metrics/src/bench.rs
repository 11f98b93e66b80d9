//! The ways to sum that the exact one is measured against, and inputs that tell them apart; behind the feature `bench`.
//!
//! Every [`Contender`] forms MAE, R² and sMAPE of two columns under one signature, so that a caller can time it, count how
//! many [`digits`] it gets right, and see whether the result survives [`shuffled`] rows. Nothing here reads a clock. How fast
//! any of them could be at best says [`stream_sum`], which reads both columns and does next to nothing with them.
//!
//! ```
//! use taceva_metrics::bench::{Contender, digits, nasty_inputs, shuffled};
//! let (_, recipe) = nasty_inputs().find(|(name, _)| *name == "offset 1e9").expect("it is one of them");
//! let columns = recipe.columns();
//! let truth = Contender::truth(columns.as_slices());
//! let naive = Contender::Naive.run(columns.as_slices());
//! assert!(digits(naive.r2.unwrap_or(f64::INFINITY), truth.r2.expect("the truth varies")) < 3.0);
//! for contender in Contender::available().into_iter().filter(|contender| contender.is_exact()) {
//!     assert_eq!(contender.run(columns.as_slices()), truth);
//!     assert_eq!(contender.run(shuffled(&columns, 7).as_slices()), truth);
//! }
//! ```

mod compensated;
mod contender;
mod digits;
mod floor;
mod numbers;
mod recipe;
mod shuffled;

pub use contender::{Contender, Scores};
pub use digits::{ALL_DIGITS, digits};
pub use floor::stream_sum;
pub use recipe::{Kind, Order, Recipe, nasty_inputs};
pub use shuffled::shuffled;
