//! Files inside the folder of a dataset, and its metadata files.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::error::{Place, TableError};
use crate::limits;
use crate::source::Source;

/// Resolves `path` in `folder`. Rejects a link that leads out of the folder.
pub(super) fn inside(folder: &Path, path: &Path) -> Result<PathBuf, TableError> {
    let whole = folder.join(path);
    let io = |source: std::io::Error| TableError::Io {
        path: whole.clone(),
        source,
    };
    let (real, root) = (
        whole.canonicalize().map_err(io)?,
        folder.canonicalize().map_err(io)?,
    );
    match real.starts_with(&root) {
        true => Ok(whole),
        false => Err(TableError::Unsupported {
            path: whole,
            place: Place::default(),
            problem: "a link leads outside the folder; copy the folder with the targets of its links (`cp -rL`)".to_owned(),
        }),
    }
}

/// Source and bytes of the metadata file `name`.
fn description(folder: &Path, name: &str) -> Result<(Source, Vec<u8>), TableError> {
    let source = Source::new(&inside(folder, name.as_ref())?)?;
    let mut file = source.open()?;
    let bytes = source.bytes(&mut file, 0, source.length(), limits::JSON_BYTES)?;
    Ok((source, bytes))
}

/// Source and parsed content of the JSON file `name`.
pub(super) fn json_file(folder: &Path, name: &str) -> Result<(Source, Value), TableError> {
    let (source, bytes) = description(folder, name)?;
    let json = serde_json::from_slice(&bytes);
    let json =
        json.map_err(|error| source.damaged(Place::default(), format!("not JSON: {error}")))?;
    Ok((source, json))
}

/// Source of a file of JSON lines, and its parsed values, each with the byte offset of its line.
pub(super) fn json_lines(
    folder: &Path,
    name: &str,
) -> Result<(Source, Vec<(u64, Value)>), TableError> {
    let (source, bytes) = description(folder, name)?;
    let mut lines = Vec::new();
    let mut at = 0_u64;
    for line in bytes.split_inclusive(|byte| *byte == b'\n') {
        if !line.trim_ascii().is_empty() {
            let value = serde_json::from_slice(line);
            let value = value
                .map_err(|error| source.damaged(Place::byte(at), format!("not JSON: {error}")))?;
            lines.push((at, value));
        }
        at += line.len() as u64;
    }
    Ok((source, lines))
}
