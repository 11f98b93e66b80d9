//! Pure statistics behind the intervals.

mod bootstrap;
pub(crate) mod jackknife;
mod method;
mod poisson;
mod random;
mod student;

pub(crate) use bootstrap::LEAST_REPLICATES;
pub use bootstrap::{BootstrapEnds, PoissonBootstrap};
pub use method::IntervalMethod;
