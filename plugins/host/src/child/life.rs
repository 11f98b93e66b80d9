//! What is known about a child, even after it ended.

use std::sync::Arc;

use super::error::ChildError;
use super::exit_status::Fate;
use super::socket::LinkError;
use super::timeouts::Patience;
use super::watch::Watch;

/// What is known about a child for as long as anybody may ask, even after it ended.
#[derive(Debug)]
pub(crate) struct Life {
    pub(super) plugin: String,
    pub(crate) watch: Arc<Watch>,
    pub(crate) patience: Patience,
}

impl Life {
    /// What became of a question that was not answered; waits until it is known how the child ended.
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

    /// Ends a child that broke a rule.
    pub(crate) fn broke(&self, what: &str) -> ChildError {
        self.lost(LinkError::Breach(what.to_owned()))
    }
}
