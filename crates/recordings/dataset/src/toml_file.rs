//! Strict parser for TOML files. An unknown key is an error with its line and the nearest key.

use std::path::Path;

use serde::de::DeserializeOwned;

use crate::error::{DatasetError, Place};
use crate::file::read_capped;
use crate::limits;
use crate::text::shown;
use taceva_core::nearest;

/// Parses the TOML file at `path` as `T`.
///
/// # Errors
/// [`DatasetError::Text`] with the line, if the file is invalid TOML or `T` rejects the content; [`DatasetError::Path`] if the file is not regular or exceeds 1
/// MiB; [`DatasetError::Io`].
pub fn read_toml<T: DeserializeOwned>(path: &Path) -> Result<T, DatasetError> {
    parse_toml(path, &read_toml_text(path)?)
}

/// Text of the TOML file at `path`.
pub fn read_toml_text(path: &Path) -> Result<String, DatasetError> {
    utf8(path, read_capped(path, limits::TOML_BYTES)?)
}

/// `bytes`, the content of the file at `path`, as UTF-8 text.
pub fn utf8(path: &Path, bytes: Vec<u8>) -> Result<String, DatasetError> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        toml_error(path, Some(line_of(error.as_bytes(), valid)), "not UTF-8")
    })
}

/// Parses `text`, the content of the file at `path`, as `T`.
pub fn parse_toml<T: DeserializeOwned>(path: &Path, text: &str) -> Result<T, DatasetError> {
    toml::from_str(text).map_err(|error| {
        let line = error
            .span()
            .map(|span| line_of(text.as_bytes(), span.start));
        toml_error(path, line, &explained(error.message()))
    })
}

/// Error for a line of the TOML file at `path`.
pub fn toml_error(path: &Path, line: Option<u64>, problem: &str) -> DatasetError {
    DatasetError::Text {
        place: Place {
            line,
            ..Place::file(path)
        },
        problem: problem.to_owned(),
    }
}

/// Line of the byte at `offset`, from 1.
pub fn line_of(text: &[u8], offset: usize) -> u64 {
    let before = &text[..offset.min(text.len())];
    1 + before.iter().filter(|byte| **byte == b'\n').count() as u64
}

/// Message of the parser with a hint: the nearest key, or that the value `unknown` is accepted.
fn explained(message: &str) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match quoted.as_slice() {
        [wrong, known @ ..] if message.starts_with("unknown field") => {
            let guess = nearest(wrong, known.iter().copied())
                .map_or_else(String::new, |guess| format!(", did you mean `{guess}`?"));
            let known = known.join(", ");
            format!("`{}`: unknown key{guess} known here: {known}", shown(wrong))
                .replace("unknown key known", "unknown key; known")
        }
        [missing] if message.starts_with("missing field") => {
            format!(
                "the key `{}` is missing{}",
                shown(missing),
                hint_for(missing)
            )
        }
        _ => taceva_core::shown(&message.trim_end().replace('\n', "; ")).to_string(),
    }
}

fn hint_for(missing: &str) -> &'static str {
    match missing {
        "serial" | "gel" | "clock" | "reference" | "opaque" => {
            "; write \"unknown\" if it was not recorded"
        }
        "unit" => "; every column states its unit, \"1\" if it has none",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only the errors are looked at")]
    struct Sensor {
        model: String,
        serial: String,
    }

    fn message(text: &str) -> String {
        let parsed: Result<Sensor, _> = parse_toml(Path::new("m.toml"), text);
        parsed.expect_err("wrong").to_string()
    }

    #[test]
    fn an_unknown_key_names_its_line_and_the_nearest_key() {
        assert_eq!(
            message("model = \"x\"\nseriel = \"y\"\n"),
            "m.toml, line 2: `seriel`: unknown key, did you mean `serial`? known here: model, serial"
        );
        assert_eq!(
            message("zzz = 1\n"),
            "m.toml, line 1: `zzz`: unknown key; known here: model, serial"
        );
    }

    #[test]
    fn a_missing_fact_says_that_unknown_is_an_answer() {
        let message = message("model = \"x\"\n");
        assert!(
            message.contains("`serial` is missing; write \"unknown\""),
            "{message}"
        );
    }
}
