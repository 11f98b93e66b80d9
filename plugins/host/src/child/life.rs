//! State of a child that clients can still use after its end.

use std::sync::Arc;

use super::error::ChildError;
use super::exit_status::Fate;
use super::socket::LinkError;
use super::timeouts::Patience;
use super::watch::Watch;

/// Name, shared state and timeouts of a child, kept by its clients even after its end.
#[derive(Debug)]
pub(crate) struct Life {
    pub(super) plugin: String,
    pub(crate) watch: Arc<Watch>,
    pub(crate) patience: Patience,
}

impl Life {
    /// Converts a link error into a [`ChildError`]. Waits for the end of the child, unless the message could not be sent.
    pub(crate) fn lost(&self, error: LinkError) -> ChildError {
        match error {
            LinkError::Unsendable(why) => return ChildError::Unsendable { why },
            LinkError::Breach(what) => self.watch.condemn(Fate::Breach { what }),
            LinkError::Closed => {}
        }
        let fate = self.watch.final_fate();
        ChildError::Gone {
            plugin: self.plugin.clone(),
            fate,
            printed: self.watch.printed(),
        }
    }

    /// Kills a child that broke a rule, and returns the error.
    pub(crate) fn broke(&self, what: &str) -> ChildError {
        self.lost(LinkError::Breach(what.to_owned()))
    }
}
