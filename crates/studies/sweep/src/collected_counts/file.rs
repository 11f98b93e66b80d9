//! Counts of a sweep in a sealed file, so that unchanged output is not written twice.

use std::fs;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use taceva_dataset::Digest;

use super::Collected;
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::seal;

/// Schema of the file.
const SCHEMA: &str = "taceva.sweep-collected/1.0";
/// Output files that must exist next to the file of counts.
const BESIDE: [&str; 5] = [
    "table.csv",
    "table.parquet",
    "times.csv",
    "page.html",
    "times.html",
];

/// Content of the sealed file.
#[derive(Serialize, Deserialize)]
struct Kept {
    schema: String,
    #[serde(flatten)]
    collected: Collected,
}

/// Beginning of the file, read first because its schema determines the rest.
#[derive(Deserialize)]
struct Head {
    #[serde(default)]
    schema: String,
}

impl Collected {
    pub(crate) fn write(&self, folder: &SweepFolder) -> Result<(), SweepError> {
        let path = path_in(folder);
        let kept = Kept {
            schema: SCHEMA.to_owned(),
            collected: self.clone(),
        };
        let text = seal::text(&kept).map_err(|problem| SweepError::Kept {
            path: path.clone(),
            problem,
        })?;
        folder.write(&path, text.as_bytes())
    }

    /// Reads the counts of the output in `folder`. Returns `None` if the output was not made from the inputs `made_of`, or if a file is missing.
    ///
    /// # Errors
    /// [`SweepError::Kept`] if the file was edited, because commands print its counts and verdicts.
    pub(crate) fn read(
        folder: &SweepFolder,
        made_of: &str,
    ) -> Result<Option<Collected>, SweepError> {
        let path = path_in(folder);
        let Some(text) = seal::read(&path)? else {
            return Ok(None);
        };
        let wrong = |problem: String| SweepError::Kept {
            path: path.clone(),
            problem: format!("{problem}; run `taceva sweep collect` to make it again"),
        };
        let head: Head = serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        if head.schema != SCHEMA {
            // Written by another version of this program.
            return Ok(None);
        }
        let Kept { collected, .. } = seal::value(&text).map_err(wrong)?;
        let is_there = BESIDE.iter().all(|name| folder.path().join(name).is_file());
        let is_same = fs::read(folder.path().join(BESIDE[0]))
            .is_ok_and(|table| Digest::of(&table).to_string() == collected.digest);
        Ok((collected.made_of == made_of && is_there && is_same).then_some(collected))
    }
}

fn path_in(folder: &SweepFolder) -> PathBuf {
    folder.path().join("collected.json")
}
