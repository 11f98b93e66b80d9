//! Stores features of frames and signals, for reuse by other models. If the total size exceeds a limit, the oldest features are removed.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Cursor, Read};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use taceva_core::{FeatureShape, Features};
use taceva_dataset::Dataset;
use taceva_models::{Extractor, FeatureSpec};

use super::value::Kept;
use super::{Cache, CachedStage, Key};
use crate::claim::{Claim, Watch};
use crate::error::EvaluateError;

/// Size limit of all stored features, in bytes.
const ALL_MAX: u64 = 2 << 30;
/// Interval at which a waiting task checks if another task has finished.
const LOOK_EVERY: Duration = Duration::from_millis(50);
/// Size limit of one set of features, in bytes.
pub(crate) const ONE_MAX: u64 = ALL_MAX / 4;

/// Features of whole recordings in memory, by key.
#[derive(Debug, Default)]
pub(super) struct Memory {
    kept: Mutex<BTreeMap<String, Arc<Features>>>,
}

impl Cache {
    /// Features of `rows`, which are all rows of `dataset` that a fold may need. Computes them with `make` unless they are in memory, and stores them in
    /// memory.
    pub(crate) fn whole_features(
        &self,
        dataset: &Dataset,
        extractor: &Extractor,
        rows: &[usize],
        make: impl FnOnce() -> Result<Features, EvaluateError>,
    ) -> Result<Arc<Features>, EvaluateError> {
        let Some(memory) = &self.memory else {
            return self.features(dataset, extractor, rows, make).map(Arc::new);
        };
        let digits = features_key(dataset, extractor, rows).digits();
        let lock = || memory.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = lock().get(&digits) {
            return Ok(Arc::clone(found));
        }
        let made = Arc::new(self.features(dataset, extractor, rows, make)?);
        lock().insert(digits, Arc::clone(&made));
        Ok(made)
    }

    /// True if features of whole recordings are stored in memory. Even large features are then computed only once.
    pub(crate) fn is_in_memory(&self) -> bool {
        self.memory.is_some()
    }

    /// Features of `rows` of `dataset` by `extractor`. Returns stored features if there are any. Otherwise calls `make` and stores the result.
    ///
    /// Features depend on frames and the reference frame, or on signals and the signals at rest. The digest of a dataset covers all of these.
    pub(crate) fn features(
        &self,
        dataset: &Dataset,
        extractor: &Extractor,
        rows: &[usize],
        make: impl FnOnce() -> Result<Features, EvaluateError>,
    ) -> Result<Features, EvaluateError> {
        let bytes = rows.len() as u64 * extractor.shape().len() as u64 * 4;
        let is_large = |frames: u64| 2 * bytes > frames;
        let is_computed_again = self.is_of_run && frame_bytes(dataset, rows).is_some_and(is_large);
        if bytes > ONE_MAX || !self.is_on_disk || is_computed_again {
            return make();
        }
        self.clear();
        let key = features_key(dataset, extractor, rows);
        if let Some(found) = self.take_value(&key) {
            let entry = File::open(self.entry(&key));
            // Marks the entry as used, because the least recently used is removed first. Failing in a read-only folder is harmless.
            drop(entry.and_then(|entry| entry.set_modified(SystemTime::now())));
            return Ok(found);
        }
        let is_shared = self.is_of_many() && self.memory.is_none();
        let turn = is_shared.then(|| self.turn(&key));
        if turn.is_some()
            && let Some(found) = self.take_value(&key)
        {
            return Ok(found);
        }
        let made = make()?;
        self.keep_value(&key, &made);
        drop(turn);
        if let Some(folder) = self.entry(&key).parent() {
            // An entry that cannot be removed now is removed with the next one.
            drop(trim(folder, ALL_MAX));
        }
        Ok(made)
    }
}

impl Cache {
    /// Waits until no other task is computing the result of `key`, and claims the computation. Returns `None` if no claim is possible, as in a
    /// read-only folder. The result may then be computed twice.
    fn turn(&self, key: &Key) -> Option<Claim> {
        let partial = self.partial();
        fs::create_dir_all(&partial).ok()?;
        let path = partial.join(format!("{}.claim", key.digits()));
        let mut watch = Watch::new(&path);
        loop {
            match Claim::take(&path) {
                Ok(Some(claim)) => return Some(claim),
                Ok(None) => {}
                Err(_) => return None,
            }
            if !watch.clear().ok()? {
                std::thread::sleep(LOOK_EVERY);
            }
        }
    }
}

/// Stored bytes of the frames of `rows`; `None` if a row has no frame in a pack.
fn frame_bytes(dataset: &Dataset, rows: &[usize]) -> Option<u64> {
    let frames = dataset.table().frames();
    let lengths = rows.iter().map(|row| {
        let span = frames[*row].as_ref()?.span?;
        Some(u64::from(span.length))
    });
    lengths.sum()
}

fn features_key(dataset: &Dataset, extractor: &Extractor, rows: &[usize]) -> Key {
    // The model itself computes principal components, from all features. Windows are joined from the features of single frames.
    let spec = FeatureSpec {
        pca: None,
        window: None,
        ..*extractor.spec()
    };
    Key::of(CachedStage::Features)
        .part("dataset", &dataset.digest().to_string())
        .whole("input", &extractor.input())
        .whole("features", &spec)
        .whole("rows", &rows)
        .finish()
}

/// Removes the least recently used files of `folder` until the total size of the remaining files is at most `most` bytes.
fn trim(folder: &Path, most: u64) -> io::Result<()> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let facts = entry.metadata()?;
        files.push((facts.modified()?, facts.len(), entry.path()));
    }
    let mut sum: u64 = files.iter().map(|(_, length, _)| length).sum();
    files.sort();
    for (_, length, path) in files {
        if sum <= most {
            break;
        }
        fs::remove_file(path)?;
        sum -= length;
    }
    Ok(())
}

/// The format is height, width and depth as 32-bit numbers, then the features as in memory, all little-endian. Features are read and written in blocks, so that
/// memory contains the matrix only once.
impl Kept for Features {
    fn to_kept(&self) -> Option<impl Read> {
        let FeatureShape {
            height,
            width,
            depth,
        } = self.shape();
        let mut head = [0; 12];
        for (place, side) in head
            .as_chunks_mut::<4>()
            .0
            .iter_mut()
            .zip([height, width, depth])
        {
            *place = u32::try_from(side).ok()?.to_le_bytes();
        }
        let values = Bytes {
            values: self.values(),
            block: Vec::with_capacity(BLOCK),
            read: 0,
        };
        Some(Cursor::new(head).chain(values))
    }

    fn from_kept(mut bytes: impl Read, length: usize) -> Option<Features> {
        let mut head = [0; 12];
        bytes.read_exact(&mut head).ok()?;
        let side = |place: usize| {
            let bytes = head.as_chunks::<4>().0[place];
            usize::try_from(u32::from_le_bytes(bytes)).ok()
        };
        let shape = FeatureShape {
            height: side(0)?,
            width: side(1)?,
            depth: side(2)?,
        };
        let length = length.checked_sub(head.len())?;
        if length % 4 != 0 {
            return None;
        }
        let mut values = Vec::with_capacity(length / 4);
        let mut block = vec![0; BLOCK];
        while values.len() < length / 4 {
            let wanted = BLOCK.min(length - 4 * values.len());
            bytes.read_exact(&mut block[..wanted]).ok()?;
            let words = block[..wanted].as_chunks::<4>().0.iter();
            values.extend(words.map(|word| f32::from_le_bytes(*word)));
        }
        Features::new(shape, values).ok()
    }
}

/// Number of bytes read at a time.
const BLOCK: usize = 1 << 16;

/// Reader that converts numbers to bytes, one block at a time.
struct Bytes<'a> {
    /// Values that are not yet converted.
    values: &'a [f32],
    block: Vec<u8>,
    /// Number of bytes of the block that were already read.
    read: usize,
}

impl Read for Bytes<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.read == self.block.len() {
            let count = self.values.len().min(BLOCK / 4);
            let (now, later) = self.values.split_at(count);
            self.block.clear();
            self.block
                .extend(now.iter().flat_map(|value| value.to_le_bytes()));
            (self.values, self.read) = (later, 0);
        }
        let mut rest = &self.block[self.read..];
        let count = rest.read(into)?;
        self.read += count;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_kept_with_their_shape_and_every_bit() {
        let shape = FeatureShape {
            height: 2,
            width: 1,
            depth: 3,
        };
        let values = vec![0.1, -0.0, 1e-30, 3.0, f32::MIN_POSITIVE, -7.5];
        let features = Features::new(shape, values).expect("one sample");
        let mut kept = Vec::new();
        let read = features.to_kept().expect("small").read_to_end(&mut kept);
        read.expect("it is in memory");
        let found = |bytes: &[u8]| Features::from_kept(bytes, bytes.len());
        assert_eq!(found(&kept), Some(features));
        // Twelve bytes are a complete matrix without samples. The digest of the file detects a truncation to that length.
        for length in (0..kept.len()).filter(|length| *length != 12) {
            assert_eq!(found(&kept[..length]), None, "{length} bytes");
        }
    }

    #[test]
    fn those_not_looked_at_for_longest_are_dropped_first() {
        let folder = tempfile::tempdir().expect("a folder");
        let now = SystemTime::now();
        for (name, age_s) in [("old", 30), ("newest", 0), ("older", 60), ("new", 10)] {
            let path = folder.path().join(name);
            fs::write(&path, [0; 100]).expect("written");
            let file = File::options().append(true).open(path).expect("there");
            let then = now - Duration::from_secs(age_s);
            file.set_modified(then).expect("dated");
        }
        trim(folder.path(), 250).expect("trimmed");
        let is_there = |name: &str| folder.path().join(name).exists();
        assert!(is_there("newest") && is_there("new"));
        assert!(!is_there("old") && !is_there("older"));
    }
}
