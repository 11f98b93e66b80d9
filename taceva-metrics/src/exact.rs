//! Sums and quotients without intermediate rounding, so that every score depends only on the set of samples.

mod block_sums;
mod bounds;
mod canonical;
mod column_kernel;
mod columns;
mod digits;
mod fixed_sum;
mod fraction;
mod grid;
mod integer;
mod kernel;
pub(crate) mod level;
mod machine;
pub(crate) mod merge;
pub(crate) mod moments;
pub(crate) mod number_key;
mod partition;
mod rational;
pub(crate) mod record;
mod rounding;
mod simd;
pub(crate) mod single;
pub(crate) mod sorted_map;
pub(crate) mod streams;
mod sum;
mod unit_sums;
mod vector;

pub(crate) use block_sums::{BlockSums, Counts, Sums};
pub use canonical::{Canonical, CanonicalError};
pub(crate) use columns::{ColumnAdder, ColumnSums};
pub(crate) use fixed_sum::FixedSum;
pub use fraction::Fraction;
pub(crate) use machine::Machine;
pub use moments::Moments;
pub use rational::Dyadic;
pub use record::Record;
pub use streams::{Stream, Streams};
pub use sum::ExactSum;
#[cfg(feature = "bench")]
pub(crate) use vector::{Job, Vector};
