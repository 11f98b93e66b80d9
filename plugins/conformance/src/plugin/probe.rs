//! Probe: the request to a child process to check one driver.

use serde::{Deserialize, Serialize};
use taceva_core::DriverKey;

use super::CheckRequest;

/// Separator between names of checks that run in one process.
pub(super) const BETWEEN: &str = ",";

/// Checks to run on one driver: the name of one check, or several names separated by commas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Probe {
    pub(crate) check: String,
    /// Key of the driver or estimator; empty for the plugin as a whole.
    pub(crate) driver: String,
    pub(crate) arguments: String,
    pub(crate) seed: u64,
    pub(crate) moves: bool,
}

impl Probe {
    /// Probe of `check` on the driver or estimator `key`, with the settings of `request`.
    pub(crate) fn of(request: &CheckRequest, check: &str, key: Option<&DriverKey>) -> Probe {
        let arguments = key.and_then(|key| request.arguments.get(key));
        Probe {
            check: check.to_owned(),
            driver: key.map(ToString::to_string).unwrap_or_default(),
            arguments: arguments.cloned().unwrap_or_default(),
            seed: request.seed,
            moves: request.moves,
        }
    }
}
