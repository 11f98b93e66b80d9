//! Data that a library states about itself, from which a manifest is written.

mod edit;

/// Contents of the manifest as the library states them. The contents are checked only when the resulting manifest is parsed.
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
    /// Id of the plugin.
    pub id: String,
    /// Version of the plugin.
    pub version: String,
    /// Needs of the plugin; empty if it states none.
    pub needs: Vec<String>,
    /// One `[[provides]]` table for each driver and estimator, without that header. The arguments are `[[args]]` instead of `[[provides.args]]`.
    pub provides: Vec<String>,
}
