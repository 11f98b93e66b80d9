//! What a library offers and needs, as it says so itself: what a manifest is written from.

mod edit;

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
