//! Queries the drivers, estimators and needs that a library offers, in a child without access to the outside.

use std::collections::BTreeMap;

use taceva_core::{DriverError, DriverKey, ErrorKind};

use super::Children;
use crate::child::{ChildSession, ChildSpec};
use crate::library::Image;
use crate::offer::Offer;
use crate::session::Session;

impl Offer {
    /// Queries the drivers, estimators and needs that the library `image` offers, in a child without access to the outside.
    ///
    /// # Errors
    /// [`DriverError`] if the library cannot be loaded or its offer cannot be read.
    pub fn of(image: &Image, children: &Children) -> Result<Offer, DriverError> {
        const DOING: &str = "list the offer of the library";
        let nameless = DriverKey::fixed("plugin");
        let spec = ChildSpec::of_library(image).map_err(|error| {
            DriverError::new(ErrorKind::Internal, &nameless, DOING).because(error)
        })?;
        let spec = ChildSpec {
            program: children.program.clone(),
            ..spec
        };
        let session = ChildSession::start(spec, nameless.clone(), BTreeMap::new())
            .map_err(|error| error.of(&nameless, DOING))?;
        session.offer()
    }
}
