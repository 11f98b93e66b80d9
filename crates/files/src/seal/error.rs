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
    /// Missing seal in a file whose version requires a seal.
    #[error(
        "the seal is missing, but files of this version need one; restore it, or accept the file as it is with `taceva reseal FILE \
         --reason …`"
    )]
    Gone,
    /// File that contains a seal and nothing else.
    #[error("a seal without its file: restore the file, or remove the seal")]
    Alone,
    /// Seal that cannot be parsed.
    #[error("the seal cannot be read: {problem}")]
    Unreadable {
        /// Reason why the seal cannot be parsed.
        problem: String,
    },
    /// Content that is neither JSON nor TOML.
    #[error("{problem}")]
    Content {
        /// Reason why the content cannot be parsed.
        problem: String,
    },
}

fn what(key: &Option<String>) -> String {
    match key {
        Some(key) => format!("`{}`", key.escape_debug()),
        None => "the file".to_owned(),
    }
}
