//! Looking for devices: each plugin is asked in a child of its own, which is ended after 10 s.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{DriverError, DriverKey, ErrorKind, Found};

use super::PluginHost;
use crate::search::Plugin;
use crate::session::Session;

/// How long a plugin may take to load, and then to say which devices a driver sees; a child that takes longer is ended.
const LOOKING: Duration = Duration::from_secs(10);

/// A session in which devices are looked for, or why there is none.
#[derive(Clone)]
pub(super) enum Looker {
    Looks(Arc<dyn Session>),
    Failed(ErrorKind, String),
}

impl PluginHost {
    /// The devices that `driver` of `plugin` sees.
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

    /// The session of `plugin` for this: started once, so that one that hangs costs its time once.
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
