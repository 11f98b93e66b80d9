//! Why a sealed file is refused.

/// Why a sealed file is refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SealError {
    /// Its content was changed after it was sealed.
    #[error(
        "{} was changed after it was sealed; restore it, or accept a deliberate edit with `taceva reseal FILE --reason …`",
        what(key)
    )]
    Changed {
        /// The key whose value was changed, where it is known.
        key: Option<String>,
    },
    /// It has no seal, though files of its version have one.
    #[error(
        "the seal is gone, which files of this version have; restore it, or accept the file as it is with `taceva reseal FILE --reason …`"
    )]
    Gone,
    /// It holds a seal and nothing else.
    #[error("a seal without the file that it belongs to")]
    Alone,
    /// The seal itself cannot be read.
    #[error("the seal cannot be read: {problem}")]
    Unreadable {
        /// What is wrong with it.
        problem: String,
    },
    /// What is sealed is neither JSON nor TOML.
    #[error("{problem}")]
    Content {
        /// What is wrong.
        problem: String,
    },
}

fn what(key: &Option<String>) -> String {
    match key {
        Some(key) => format!("`{}`", key.escape_debug()),
        None => "the file".to_owned(),
    }
}
