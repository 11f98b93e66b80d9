//! Why a file is not believed.

/// Why a file is not believed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SealError {
    /// It does not say what it said when it was sealed.
    #[error(
        "{} was changed after it was sealed; restore it, or accept a deliberate edit with `taceva reseal FILE --reason …`",
        what(key)
    )]
    Changed {
        /// The key whose value is another, where it is known.
        key: Option<String>,
    },
    /// Its version says that there must be a seal.
    #[error(
        "the seal is gone, which files of this version have; restore it, or accept the file as it is with `taceva reseal FILE --reason …`"
    )]
    Gone,
    /// Nothing stands before the seal.
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
