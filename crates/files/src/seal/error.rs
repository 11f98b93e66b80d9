//! Errors of sealed files.

/// Error of a sealed file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SealError {
    /// Content that changed after sealing.
    #[error(
        "{} was changed after it was sealed; restore it, or accept a deliberate edit with `taceva reseal FILE --reason …`",
        what(key)
    )]
    Changed {
        /// Key of the changed value, if known.
        key: Option<String>,
    },
    /// Missing seal in a file whose version requires one.
    #[error(
        "the seal is gone, but files of this version need one; restore it, or accept the file as it is with `taceva reseal FILE \
         --reason …`"
    )]
    Gone,
    /// Seal without its file.
    #[error("a seal without the file that it belongs to")]
    Alone,
    /// Unreadable seal.
    #[error("the seal cannot be read: {problem}")]
    Unreadable {
        /// Problem with the seal.
        problem: String,
    },
    /// Content that is neither JSON nor TOML.
    #[error("{problem}")]
    Content {
        /// Problem with the content.
        problem: String,
    },
}

fn what(key: &Option<String>) -> String {
    match key {
        Some(key) => format!("`{}`", key.escape_debug()),
        None => "the file".to_owned(),
    }
}
