//! Device discovery: each plugin searches in a separate child with a timeout of 10 s.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{DriverError, DriverKey, ErrorKind, Found};

use super::PluginHost;
use crate::search::Plugin;
use crate::session::Session;

/// Timeout for loading a plugin, and for listing the devices of a driver.
const LOOKING: Duration = Duration::from_secs(10);

/// Session for device discovery, or the reason for its failure.
#[derive(Clone)]
pub(super) enum Looker {
    Looks(Arc<dyn Session>),
    Failed(ErrorKind, String),
}

impl PluginHost {
    /// Lists the devices that `driver` of `plugin` finds.
    pub(super) fn look(
        &self,
        plugin: &Plugin,
        driver: &DriverKey,
    ) -> Result<Vec<Found>, DriverError> {
        match self.looker(plugin, driver) {
            Looker::Looks(session) => {
                let grant = self.config.grant(plugin);
                let found = session.discover(driver);
                found.map_err(|error| grant.withheld.explained(error))
            }
            Looker::Failed(kind, why) => {
                Err(DriverError::new(kind, driver, "look for devices").because(why))
            }
        }
    }

    /// Discovery session of `plugin`. The session is started only once, so that a hanging plugin causes only one timeout.
    fn looker(&self, plugin: &Plugin, driver: &DriverKey) -> Looker {
        let mut lookers = self.lock_lookers();
        if let Some(looker) = lookers.get(plugin.id()) {
            return looker.clone();
        }
        let looker =
            match self.start_within(plugin, driver, &self.config.grant(plugin), Some(LOOKING)) {
                Ok((session, _)) => Looker::Looks(session),
                Err(error) => {
                    let why = std::error::Error::source(&error).map(ToString::to_string);
                    Looker::Failed(error.kind(), why.unwrap_or_else(|| error.to_string()))
                }
            };
        lookers.insert(plugin.id().clone(), looker.clone());
        looker
    }
}
