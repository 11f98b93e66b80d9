//! View of the cache for one study of a run.

use std::path::Path;

use taceva_dataset::Dataset;

use super::value::Kept;
use super::{Cache, CachedStage, Key};

/// A stage of a study, and whether its result was reused.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct StageRecord {
    /// Name of the study.
    pub study: String,
    /// Stage of the run.
    pub stage: CachedStage,
    /// Digest of all inputs of the stage's result.
    pub key: String,
    /// True if the result was found in the cache.
    pub reused: bool,
}

/// View of the cache for one study. Without a cache, every stage is computed.
#[derive(Clone, Copy)]
pub struct StudyCache<'a> {
    /// Cache to use; `None` to compute every stage.
    pub cache: Option<&'a Cache>,
    /// Number of the study, counted from 0.
    pub number: usize,
    /// Name of the study.
    pub study: &'a str,
}

impl StudyCache<'_> {
    /// Returns the value stored under `key`. Without a stored value, calls `make` and stores the result.
    pub fn value<T: Kept, E>(self, key: &Key, make: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        let Some(cache) = self.cache else {
            return make();
        };
        if let Some(value) = cache.take_value(key) {
            self.record(key, true);
            return Ok(value);
        }
        let value = make()?;
        cache.keep_value(key, &value);
        self.record(key, false);
        Ok(value)
    }

    /// Links the recording stored under `key` to `place`, and returns it with `true`. If `place` exists or no recording is stored, calls `make`,
    /// stores its result, and returns it with `false`.
    pub fn recording<E>(
        self,
        key: &Key,
        place: &Path,
        make: impl FnOnce() -> Result<Dataset, E>,
    ) -> Result<(Dataset, bool), E> {
        let Some(cache) = self.cache else {
            return Ok((make()?, false));
        };
        // A recording that was started there is continued.
        let found = (!place.exists()).then(|| cache.take_recording(key, place));
        if let Some(dataset) = found.flatten() {
            self.record(key, true);
            return Ok((dataset, true));
        }
        let dataset = make()?;
        cache.keep_recording(key, place);
        self.record(key, false);
        Ok((dataset, false))
    }

    fn record(self, key: &Key, reused: bool) {
        let record = StageRecord {
            study: self.study.to_owned(),
            stage: key.stage(),
            key: key.to_string(),
            reused,
        };
        if let Some(cache) = self.cache {
            cache.record(self.number, record);
        }
    }
}
