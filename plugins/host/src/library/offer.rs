//! Drivers, estimators and needs of a loaded library.

use super::{Library, LoadProblem, text};
use crate::offer::Offer;

impl Library {
    /// Lists the drivers, estimators and needs of the library.
    pub fn offer(&self) -> Result<Offer, LoadProblem> {
        let said = self.plugin();
        let needs = text("`needs`", said.needs, None)?;
        let needs = needs.lines().map(str::trim).filter(|need| !need.is_empty());
        // Entries in the order of the library.
        let mut entries: Vec<_> = self.entries.values().collect();
        entries.sort_by_key(|entry| (entry.place, entry.number));
        Ok(Offer {
            id: self.id().to_string(),
            version: text("`version`", said.version, None)?.to_owned(),
            needs: needs.map(str::to_owned).collect(),
            provides: entries.iter().map(|entry| entry.text.clone()).collect(),
        })
    }
}
