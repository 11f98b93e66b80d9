//! Pure statistics: how far a score would move with other contact locations, and whether two scores differ.

mod bootstrap;
mod cluster_sums;
mod difference;
mod ends;
mod error;
mod exponential;
mod holm;
pub(crate) mod jackknife;
mod logarithm;
mod method;
mod paired_clusters;
mod poisson;
mod random;
mod repeats;
mod sides;
mod sign_flip;
mod signed_sums;
mod student;
mod verdict;
mod welch;
pub(crate) mod wilson;

pub(crate) use bootstrap::LEAST_REPLICATES;
pub use bootstrap::{BootstrapEnds, PoissonBootstrap};
pub use cluster_sums::{ClusterSum, ClusterSums};
pub use difference::{Difference, DifferenceTest, decide};
pub(crate) use ends::Estimated;
pub use ends::Scale;
pub use error::ComparisonError;
pub use holm::holm;
pub use method::IntervalMethod;
pub use repeats::Repeats;
pub use sides::{Side, Sides};
pub use sign_flip::SignFlip;
pub use verdict::{Question, Verdict};
pub use welch::{Estimate, welch};
