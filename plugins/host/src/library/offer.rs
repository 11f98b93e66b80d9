//! What a library offers and needs, as it says so itself: what a manifest is written from.

use super::{Library, LoadProblem, text};

/// What a library says that a manifest says too. Nothing of it was checked by anybody but by whoever reads the manifest that is made of it.
///
/// ```
/// use taceva_host::{LibraryFile, Offer};
/// let offer = Offer {
///     id: "org.example.scale".to_owned(),
///     version: "1.0.0".to_owned(),
///     needs: vec!["hid".to_owned()],
///     provides: vec!["kind = \"force\"\nkey = \"scale\"\ntitle = \"scale\"\nsource = \"real\"\naxes = [\"Fz\"]\n".to_owned()],
/// };
/// let library = LibraryFile { path: "libscale.so".to_owned(), sha256: None };
/// let manifest = offer.manifest("", &library, Some("MIT"))?;
/// assert!(manifest.contains("needs = [\"hid\"]"));
/// assert_eq!(offer.manifest(&manifest, &library, None)?, manifest);
/// # Ok::<(), taceva_host::ManifestError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Offer {
    /// The id of the plugin.
    pub id: String,
    /// Its version.
    pub version: String,
    /// What it must reach outside itself; empty where it does not say.
    pub needs: Vec<String>,
    /// A `[[provides]]` table for each driver and estimator, without that header and with `[[args]]` for `[[provides.args]]`.
    pub provides: Vec<String>,
}

impl Offer {
    /// What the library of `image` says, asked in a process that reaches nothing.
    ///
    /// # Errors
    /// [`DriverError`] if it cannot be loaded, or says what cannot be read.
    #[cfg(target_os = "linux")]
    pub fn of(
        image: &crate::Image,
        children: &crate::Children,
    ) -> Result<Offer, taceva_core::DriverError> {
        use crate::child::{ChildSession, ChildSpec};
        use crate::session::Session;
        use taceva_core::{DriverError, DriverKey, ErrorKind};

        const DOING: &str = "ask the library what it offers";
        let nameless = DriverKey::fixed("plugin");
        let spec = ChildSpec::of_library(image).map_err(|error| {
            DriverError::new(ErrorKind::Internal, &nameless, DOING).because(error)
        })?;
        let spec = ChildSpec {
            program: children.program.clone(),
            ..spec
        };
        let session =
            ChildSession::start(spec, nameless.clone(), std::collections::BTreeMap::new())
                .map_err(|error| error.of(&nameless, DOING))?;
        session.offer()
    }
}

impl Library {
    /// What it offers and needs.
    pub(crate) fn offer(&self) -> Result<Offer, LoadProblem> {
        let said = self.plugin();
        let needs = text("`needs`", said.needs, None)?;
        let needs = needs.lines().map(str::trim).filter(|need| !need.is_empty());
        // In the order in which the library lists them.
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
