//! Caches the results of the stages of runs, under the digest of all their inputs.
//!
//! ```text
//! FOLDER/2/acquire/<key>      one line for each run folder with the closed recording, the latest first
//!         /features/<key>     features of frames, in the format of a model
//!         /fit/<key>          a model: its digest in the first line, then its bytes
//!         /predict/<key>      numbers, in the same format
//!         /partial/           unfinished entries: renamed when complete, left behind by a stopped run
//! ```
//!
//! Scores are not cached, because computing them takes less time than a safe look-up.

mod features;
mod inventory;
mod key;
mod recording;
mod study;
mod tree;
mod value;

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, Once, PoisonError};
use std::time::Duration;

use taceva_core::shown;
use taceva_files::{STAGED, TemporaryFolder, clear_leftovers};

use crate::claim::clear_dead_claims;
pub(crate) use features::ONE_MAX;
pub use inventory::{CacheEntry, Pruning, cache_entries, pruned, remove_entry};
pub use key::CachedStage;
pub use key::{Key, KeyBuilder};
pub use study::StageRecord;
pub use study::StudyCache;
pub use tree::remove;
pub use value::Kept;

/// Version of the layout of entries. Each version has its own folder, so that a program never reads entries of another version.
const LAYOUT: &str = "2";
/// Name of the folder for entries that are still being written.
const PARTIAL: &str = "partial";
/// Age at which a partial entry counts as abandoned. Writing a result always takes less time.
const ABANDONED: Duration = Duration::from_secs(24 * 60 * 60);

/// A folder of results that runs share, and a list of the results that this run reused.
///
/// A cache never stops a run. If it cannot be read or written, stages are computed again, and [`notes`](Cache::notes) states the reason. Any number of runs can
/// share a cache, because an entry is visible only when complete, and its name is the digest of its inputs.
#[derive(Debug)]
pub struct Cache {
    folder: PathBuf,
    models: String,
    /// True if many concurrent tasks use features of the same recordings.
    is_of_many: bool,
    /// True if the folder stores only features of at most half of the bytes of their frames.
    is_of_run: bool,
    /// Features of whole recordings, for the folds of one call; `None` if no features are kept in memory.
    memory: Option<features::Memory>,
    /// Rows whose features are computed together; `None` for all rows with an input.
    rows: Option<Vec<usize>>,
    /// True if entries are stored in the folder.
    is_on_disk: bool,
    /// Guard that removes leftovers of killed runs once.
    cleared: Once,
    notes: Mutex<BTreeSet<String>>,
    records: Mutex<Vec<(usize, StageRecord)>>,
}

impl Cache {
    /// Cache in `folder`. The folder is created when the first result is stored.
    ///
    /// `models` names the simulation models of the program's drivers, with version and parameters. Recordings made by other models are not reused.
    pub fn new(folder: PathBuf, models: String) -> Cache {
        Cache {
            folder,
            models,
            is_of_many: false,
            is_of_run: false,
            memory: None,
            rows: None,
            is_on_disk: true,
            cleared: Once::new(),
            notes: Mutex::default(),
            records: Mutex::default(),
        }
    }

    /// Shares this cache among many tasks, in this process and in other processes that use the folder. Features are computed for whole recordings,
    /// even if a task needs only some rows. One task computes them while other tasks wait. Each frame is then decoded once for each kind of features,
    /// if the cache can store these features.
    #[must_use]
    pub fn of_many(self) -> Cache {
        Cache {
            is_of_many: true,
            ..self
        }
    }

    /// Stores only features that take at most half of the bytes of their frames. Larger features are computed again from the frames, because a run
    /// rarely fits two models to the same features.
    #[must_use]
    pub fn of_run(self) -> Cache {
        Cache {
            is_of_run: true,
            ..self
        }
    }

    /// Cache for the folds of one call. Features of whole recordings are stored in memory, and also in the folder of `outer`.
    pub(crate) fn of_folds(outer: Option<&Cache>) -> Cache {
        let folder = outer.map_or_else(PathBuf::new, |outer| outer.folder.clone());
        let models = outer.map_or_else(String::new, |outer| outer.models.clone());
        Cache {
            memory: Some(features::Memory::default()),
            is_on_disk: outer.is_some(),
            is_of_many: true,
            is_of_run: outer.is_some_and(|outer| outer.is_of_run),
            ..Cache::new(folder, models)
        }
    }

    /// Cache for the folds of one call that read only the ascending `rows` of one recording. Other frames of the recording are not decoded.
    pub fn of_folded_rows(outer: Option<&Cache>, rows: Vec<usize>) -> Cache {
        Cache {
            rows: Some(rows),
            ..Cache::of_folds(outer)
        }
    }

    /// Rows whose features are computed together; `None` for all rows with an input.
    pub(crate) fn rows(&self) -> Option<&[usize]> {
        self.rows.as_deref()
    }

    /// True if features are computed for whole recordings.
    pub fn is_of_many(&self) -> bool {
        self.is_of_many
    }

    /// Path of the cache folder.
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Messages for the user, about a folder that cannot be written and about damaged entries.
    pub fn notes(&self) -> Vec<String> {
        let notes = self.notes.lock().unwrap_or_else(PoisonError::into_inner);
        notes.iter().cloned().collect()
    }

    /// Finished stages of the run, study by study. Each record states whether the result was reused.
    pub fn stages(&self) -> Vec<StageRecord> {
        let records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
        let mut records = records.clone();
        records.sort_by_key(|(study, record)| (*study, record.stage));
        records.into_iter().map(|(_, record)| record).collect()
    }

    /// Simulation models of the drivers, as given to [`Cache::new`].
    pub fn models(&self) -> &str {
        &self.models
    }

    fn note(&self, note: String) {
        let mut notes = self.notes.lock().unwrap_or_else(PoisonError::into_inner);
        notes.insert(note);
    }

    fn record(&self, study: usize, record: StageRecord) {
        let mut records = self.records.lock().unwrap_or_else(PoisonError::into_inner);
        records.push((study, record));
    }

    /// Path of the entry of `key`.
    fn entry(&self, key: &Key) -> PathBuf {
        let folder = self.folder.join(LAYOUT).join(key.stage().name());
        folder.join(key.digits())
    }

    /// Path of the folder for entries that are still being written.
    fn partial(&self) -> PathBuf {
        self.folder.join(LAYOUT).join(PARTIAL)
    }

    /// Removes the partial entries and the claim files that killed runs left.
    fn clear(&self) {
        self.cleared.call_once(|| {
            let partial = self.partial();
            clear_leftovers(&partial);
            clear_dead_claims(&partial);
        });
    }

    /// Writes an entry by `write` to a temporary path, and renames it. If another run has stored the entry first, the new entry is discarded.
    ///
    /// `write` creates a file or a folder. It must fail if the path exists.
    fn put(&self, key: &Key, write: impl Fn(&Path) -> io::Result<()>) {
        let entry = self.entry(key);
        if let Err(error) = self.try_put(&entry, write)
            && !entry.exists()
        {
            self.note_unwritable(&error);
        }
    }

    /// Replaces the entry of `key` by a file with the content `bytes`.
    fn put_anew(&self, key: &Key, bytes: &[u8]) {
        let entry = self.entry(key);
        let write = |beside: &Path| {
            let mut file = File::options().write(true).create_new(true).open(beside)?;
            file.write_all(bytes)?;
            file.sync_all()
        };
        if let Err(error) = self.try_put(&entry, write) {
            self.note_unwritable(&error);
        }
    }

    fn note_unwritable(&self, error: &io::Error) {
        self.note(format!(
            "cannot write to the cache {}, so results are not stored: {error}",
            shown(&self.folder)
        ));
    }

    fn try_put(&self, entry: &Path, write: impl Fn(&Path) -> io::Result<()>) -> io::Result<()> {
        let partial = self.partial();
        for folder in entry.parent().into_iter().chain([partial.as_path()]) {
            fs::create_dir_all(folder)?;
        }
        let folder = TemporaryFolder::create(&partial, STAGED)?;
        let staged = folder.path().join("entry");
        write(&staged)?;
        fs::rename(&staged, entry)
    }

    fn note_unreadable(&self, entry: &Path, error: &io::Error) {
        self.note(format!("{} cannot be used: {error}", shown(entry)));
    }

    /// Removes a damaged entry. Its stage is then computed again.
    fn discard(&self, key: &Key, problem: &str) {
        let entry = self.entry(key);
        let removed = remove(&entry);
        self.note(format!(
            "{}: {problem}; this entry is {} and computed again",
            shown(&entry),
            match removed {
                Ok(()) => "removed".to_owned(),
                Err(error) => format!("kept (cannot remove it: {error})"),
            }
        ));
    }
}
