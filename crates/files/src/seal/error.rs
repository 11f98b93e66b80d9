//! Errors of sealed files.

/// Refusal of a sealed file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SealError {
    /// Content that was changed after it was sealed.
    #[error(
        "{} was changed after it was sealed; restore it, or accept a deliberate edit with `taceva reseal FILE --reason …`",
        what(key)
    )]
    Changed {
        /// The key whose value was changed, where it is known.
        key: Option<String>,
    },
    /// Missing seal, though files of this version have one.
    #[error(
        "the seal is gone, which files of this version have; restore it, or accept the file as it is with `taceva reseal FILE --reason …`"
    )]
    Gone,
    /// Seal without a file that it belongs to.
    #[error("a seal without the file that it belongs to")]
    Alone,
    /// The seal itself cannot be read.
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
