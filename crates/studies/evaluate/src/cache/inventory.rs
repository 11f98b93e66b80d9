//! Lists the entries in a cache folder, and chooses entries to remove.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use taceva_files::{STAGED, TemporaryFolder};

use super::key::CachedStage;
use super::{ABANDONED, LAYOUT, PARTIAL, remove};

/// Number of digits of a key.
const DIGITS: usize = 64;

/// An entry: the result of a stage, or a partial entry of a stopped run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CacheEntry {
    /// Stage of the result; `None` for a partial entry.
    pub stage: Option<CachedStage>,
    /// Hexadecimal digits of the key, or name of a partial entry.
    pub name: String,
    /// Path of the entry.
    pub path: PathBuf,
    /// Size of the entry, in bytes.
    pub bytes: u64,
    /// Number of bytes that are freed by removing the entry. Excludes files shared with the folder of a run.
    pub own_bytes: u64,
    /// Number of files in the entry.
    pub files: u64,
    /// Time of creation or last use.
    pub used: SystemTime,
}

impl CacheEntry {
    /// Kind of the entry: name of the stage, or `partial`.
    pub fn kind(&self) -> &'static str {
        self.stage.map_or(PARTIAL, CachedStage::name)
    }

    /// Time since the last use; zero if the last use is in the future.
    pub fn age(&self, now: SystemTime) -> Duration {
        now.duration_since(self.used).unwrap_or_default()
    }
}

/// Rules for removing entries.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pruning {
    /// Stages whose results are removed; empty for all stages.
    pub stages: Vec<CachedStage>,
    /// Age limit, if any. Entries that were not used for a longer time are removed.
    pub older_than: Option<Duration>,
    /// Size limit in bytes, if any. The least recently used entries are removed until the total is at most this limit.
    pub keep: Option<u64>,
}

/// All entries in `folder`, by kind, the least recently used first; empty if the folder does not exist.
///
/// Lists only files of this program.
///
/// # Errors
/// If the folder cannot be read.
pub fn cache_entries(folder: &Path) -> io::Result<Vec<CacheEntry>> {
    let mut entries = Vec::new();
    let layout = folder.join(LAYOUT);
    for stage in CachedStage::ALL {
        gather(&layout.join(stage.name()), Some(stage), &mut entries)?;
    }
    gather(&layout.join(PARTIAL), None, &mut entries)?;
    entries.sort_by(|left, right| {
        (left.stage, left.used, &left.name).cmp(&(right.stage, right.used, &right.name))
    });
    Ok(entries)
}

fn gather(
    folder: &Path,
    stage: Option<CachedStage>,
    entries: &mut Vec<CacheEntry>,
) -> io::Result<()> {
    let found = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        found => found?,
    };
    for entry in found {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_ours = match stage {
            Some(_) => name.len() == DIGITS && name.bytes().all(|byte| byte.is_ascii_hexdigit()),
            None => is_partial(&name),
        };
        // A run may have completed or removed it meanwhile.
        if is_ours && let Ok(facts) = fs::symlink_metadata(entry.path()) {
            let mut sum = Sum::default();
            sum.add(&entry.path(), &facts)?;
            entries.push(CacheEntry {
                stage,
                name,
                path: entry.path(),
                bytes: sum.bytes,
                own_bytes: sum.own_bytes,
                files: sum.files,
                used: facts.modified()?,
            });
        }
    }
    Ok(())
}

/// True for the name of a file that a run is writing.
fn is_partial(name: &str) -> bool {
    name.starts_with(STAGED)
}

#[derive(Default)]
struct Sum {
    bytes: u64,
    own_bytes: u64,
    files: u64,
}

impl Sum {
    fn add(&mut self, path: &Path, facts: &Metadata) -> io::Result<()> {
        if facts.is_dir() {
            for entry in fs::read_dir(path)? {
                let entry = entry?;
                self.add(&entry.path(), &entry.metadata()?)?;
            }
            return Ok(());
        }
        self.files += 1;
        self.bytes += facts.len();
        if !is_shared(facts) {
            self.own_bytes += facts.len();
        }
        Ok(())
    }
}

/// True if a file has another hard link. Removing the file then frees no space.
fn is_shared(facts: &Metadata) -> bool {
    #[cfg(unix)]
    let links = std::os::unix::fs::MetadataExt::nlink(facts);
    #[cfg(not(unix))]
    let links = {
        let _ = facts;
        1
    };
    links > 1
}

/// Entries that `pruning` removes at the time `now`. Entries that are too old come first, followed by entries beyond the size limit.
///
/// Partial entries that no run can still be writing, because they are too old, are always removed.
pub fn pruned<'a>(
    entries: &'a [CacheEntry],
    pruning: &Pruning,
    now: SystemTime,
) -> Vec<&'a CacheEntry> {
    let is_asked = |entry: &CacheEntry| match entry.stage {
        Some(stage) => pruning.stages.is_empty() || pruning.stages.contains(&stage),
        None => false,
    };
    let is_old = |entry: &CacheEntry| pruning.older_than.is_some_and(|age| entry.age(now) > age);
    let mut staying: Vec<&CacheEntry> = Vec::new();
    let mut going: Vec<&CacheEntry> = Vec::new();
    for entry in entries {
        match entry.stage {
            None if entry.age(now) > ABANDONED => going.push(entry),
            None => {}
            Some(_) if is_asked(entry) && is_old(entry) => going.push(entry),
            Some(_) if is_asked(entry) => staying.push(entry),
            Some(_) => {}
        }
    }
    if let Some(keep) = pruning.keep {
        staying.sort_by_key(|entry| entry.used);
        let mut sum: u64 = staying.iter().map(|entry| entry.bytes).sum();
        for entry in staying {
            if sum <= keep {
                break;
            }
            sum -= entry.bytes;
            going.push(entry);
        }
    }
    going
}

/// Removes `entry` from the cache in `folder`. A concurrent run finds either the whole entry or no entry.
///
/// # Errors
/// If the entry cannot be renamed or removed.
pub fn remove_entry(folder: &Path, entry: &CacheEntry) -> io::Result<()> {
    if entry.stage.is_none() {
        return remove(&entry.path);
    }
    let partial = folder.join(LAYOUT).join(PARTIAL);
    fs::create_dir_all(&partial)?;
    let folder = TemporaryFolder::create(&partial, STAGED)?;
    match fs::rename(&entry.path, folder.path().join("entry")) {
        // Another process was faster.
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        moved => moved,
    }
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::*;

    const HOUR: Duration = Duration::from_secs(3600);

    /// Test cache with a file of `bytes` bytes for each stage and age, in hours.
    fn cache(kept: &[(CachedStage, u64, usize)]) -> (tempfile::TempDir, Vec<CacheEntry>) {
        let folder = tempfile::tempdir().expect("a folder");
        for (number, (stage, hours, bytes)) in kept.iter().enumerate() {
            let path = folder.path().join(LAYOUT).join(stage.name());
            fs::create_dir_all(&path).expect("made");
            let path = path.join(format!("{number:064x}"));
            fs::write(&path, vec![0; *bytes]).expect("written");
            let file = File::options().append(true).open(path).expect("there");
            let hours = u32::try_from(*hours).expect("few");
            file.set_modified(SystemTime::now() - HOUR * hours)
                .expect("dated");
        }
        let entries = cache_entries(folder.path()).expect("readable");
        (folder, entries)
    }

    fn names(entries: &[&CacheEntry]) -> Vec<String> {
        entries
            .iter()
            .map(|entry| entry.name.trim_start_matches('0').to_owned())
            .collect()
    }

    #[test]
    fn what_is_not_of_this_program_is_neither_listed_nor_removed() {
        let (folder, _) = cache(&[(CachedStage::Fit, 1, 10)]);
        let layout = folder.path().join(LAYOUT);
        for stranger in ["fit/notes.txt", "fit/0123", "mine", "../thesis.tex"] {
            fs::write(layout.join(stranger), "keep me").expect("written");
        }
        fs::create_dir_all(layout.join(PARTIAL).join("thesis")).expect("made");
        let entries = cache_entries(folder.path()).expect("readable");
        assert_eq!(entries.len(), 1, "{entries:?}");
        let all = Pruning {
            keep: Some(0),
            ..Pruning::default()
        };
        for entry in pruned(&entries, &all, SystemTime::now()) {
            remove_entry(folder.path(), entry).expect("removed");
        }
        assert!(cache_entries(folder.path()).expect("readable").is_empty());
        assert!(layout.join("fit/notes.txt").exists() && layout.join("../thesis.tex").exists());
        assert!(layout.join("partial/thesis").exists());
    }

    #[test]
    fn the_longest_unused_go_first_until_the_rest_fits() {
        let kept = [
            (CachedStage::Fit, 3, 100),
            (CachedStage::Features, 9, 100),
            (CachedStage::Predict, 1, 100),
        ];
        let (_folder, entries) = cache(&kept);
        let keep = |bytes| Pruning {
            keep: Some(bytes),
            ..Pruning::default()
        };
        let gone = |pruning: &Pruning| names(&pruned(&entries, pruning, SystemTime::now()));
        assert_eq!(gone(&keep(300)), Vec::<String>::new());
        assert_eq!(gone(&keep(299)), ["1"]);
        assert_eq!(gone(&keep(100)), ["1", ""]);
        let features = Pruning {
            stages: vec![CachedStage::Predict],
            keep: Some(0),
            ..Pruning::default()
        };
        assert_eq!(gone(&features), ["2"]);
        let old = Pruning {
            older_than: Some(2 * HOUR),
            ..Pruning::default()
        };
        assert_eq!(gone(&old).len(), 2);
    }

    #[test]
    fn what_a_run_may_be_writing_stays_and_what_it_left_a_day_ago_goes() {
        let (folder, _) = cache(&[]);
        let partial = folder.path().join(LAYOUT).join(PARTIAL);
        fs::create_dir_all(&partial).expect("made");
        for (name, hours) in [(".taceva-staged-a1b2c3", 1), (".taceva-staged-d4e5f6", 25)] {
            let file = File::create(partial.join(name)).expect("made");
            file.set_modified(SystemTime::now() - HOUR * hours)
                .expect("dated");
        }
        let entries = cache_entries(folder.path()).expect("readable");
        assert_eq!(entries.len(), 2);
        let all = Pruning {
            keep: Some(0),
            older_than: Some(Duration::ZERO),
            ..Pruning::default()
        };
        assert_eq!(
            names(&pruned(&entries, &all, SystemTime::now())),
            [".taceva-staged-d4e5f6"]
        );
    }
}
