//! Probe: the order to a child to check one driver.

use serde::{Deserialize, Serialize};

/// One check on one driver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Probe {
    pub(crate) check: String,
    /// The key of the driver or estimator; empty for the plugin as a whole.
    pub(crate) driver: String,
    pub(crate) arguments: String,
    pub(crate) seed: u64,
    pub(crate) moves: bool,
}
