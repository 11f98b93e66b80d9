//! Sealed JSON files. The seal detects later edits.

use std::fs;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::SweepError;

/// Text of the file at `path`; `None` if it does not exist.
pub(crate) fn read(path: &Path) -> Result<Option<String>, SweepError> {
    match fs::read_to_string(path) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(SweepError::io("read", path)(error)),
    }
}

/// Converts `value` to sealed JSON; the error is a message if it has no JSON form.
pub(crate) fn text(value: &impl Serialize) -> Result<String, String> {
    let text = serde_json::to_string(value).map_err(|error| error.to_string())?;
    taceva_files::seal::json::seal(&text).map_err(|error| error.to_string())
}

/// Parses sealed JSON; the error is a message if the text is invalid or was edited.
pub(crate) fn value<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    taceva_files::seal::json::check(text).map_err(|error| error.to_string())?;
    serde_json::from_str(text).map_err(|error| error.to_string())
}
