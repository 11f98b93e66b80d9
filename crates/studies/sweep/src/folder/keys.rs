//! Finds results and failures in the folder of a sweep by their file names.

use std::collections::BTreeSet;
use std::fs;

use super::SweepFolder;
use crate::error::SweepError;
use crate::key::TaskKey;

impl SweepFolder {
    /// Keys of existing results, from their file names.
    pub(crate) fn results(&self) -> Result<BTreeSet<String>, SweepError> {
        self.keys("results")
    }

    /// Keys of failed tasks.
    pub(crate) fn failures(&self) -> Result<BTreeSet<String>, SweepError> {
        self.keys("failed")
    }

    fn keys(&self, name: &str) -> Result<BTreeSet<String>, SweepError> {
        let folder = self.path.join(name);
        let entries = match fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return Ok(BTreeSet::new());
            }
            Err(error) => return Err(SweepError::io("list", &folder)(error)),
        };
        let mut keys = BTreeSet::new();
        for entry in entries {
            let entry = entry.map_err(SweepError::io("list", &folder))?;
            let name = entry.file_name();
            let key = name.to_str().and_then(|name| name.strip_suffix(".json"));
            keys.extend(key.filter(|key| TaskKey::is_one(key)).map(str::to_owned));
        }
        Ok(keys)
    }
}
