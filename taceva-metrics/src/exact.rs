//! Sums and quotients without rounding: what makes every score a function of the set of samples alone.

mod canonical;
mod integer;
pub(crate) mod kernel;
mod rational;
mod round;
mod sum;

pub use canonical::{Canonical, CanonicalError};
pub(crate) use rational::Dyadic;
pub use sum::ExactSum;
