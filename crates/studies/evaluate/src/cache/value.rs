//! Small stored results, one per file. The first line is the digest of the remaining content.

use std::fs::File;
use std::io::{self, BufReader, Cursor, Read, Seek, SeekFrom, Write};

use taceva_core::Column;
use taceva_dataset::Digest;
use taceva_models::Model;

use super::{Cache, Key};

/// A result that can be stored in a file.
pub trait Kept: Sized {
    /// Returns a reader of the stored form; `None` if the value cannot be stored.
    fn to_kept(&self) -> Option<impl Read>;

    /// Parses a value from `length` stored bytes; `None` if they do not contain such a value.
    fn from_kept(bytes: impl Read, length: usize) -> Option<Self>;
}

/// A model of a plugin is not stored, because only the plugin can load it.
impl Kept for Model {
    fn to_kept(&self) -> Option<impl Read> {
        let is_of_plugin = self.card().plugin.is_some();
        let bytes = self.to_bytes().ok().filter(|_| !is_of_plugin);
        bytes.map(Cursor::new)
    }

    fn from_kept(bytes: impl Read, length: usize) -> Option<Model> {
        Model::from_bytes(&all_of(bytes, length)?).ok()
    }
}

/// The format has a byte for each row, which is 1 if there is a value, and then the bits of the value.
impl Kept for Column {
    fn to_kept(&self) -> Option<impl Read> {
        let rows = (0..self.len()).map(|row| self.get(row));
        let bytes = rows.flat_map(|value| {
            let mut bytes = [0; 9];
            bytes[0] = u8::from(value.is_some());
            bytes[1..].copy_from_slice(&value.unwrap_or(0.0).to_le_bytes());
            bytes
        });
        Some(Cursor::new(bytes.collect::<Vec<u8>>()))
    }

    fn from_kept(bytes: impl Read, length: usize) -> Option<Column> {
        let bytes = all_of(bytes, length)?;
        let (rows, []) = bytes.as_chunks::<9>() else {
            return None;
        };
        let mut column = Column::default();
        for [is_there, bits @ ..] in rows {
            column.push((*is_there == 1).then_some(f64::from_le_bytes(*bits)));
        }
        Some(column)
    }
}

fn all_of(mut bytes: impl Read, length: usize) -> Option<Vec<u8>> {
    let mut all = Vec::with_capacity(length);
    bytes.read_to_end(&mut all).ok()?;
    Some(all)
}

/// Length of the first line, in bytes. The line consists of the digest and the line end.
const FIRST_LINE: usize = 72;

impl Cache {
    /// Returns the result stored under `key`; `None` without a stored result, or if its bytes have changed.
    pub(super) fn take_value<T: Kept>(&self, key: &Key) -> Option<T> {
        let entry = self.entry(key);
        let file = match File::open(&entry) {
            Ok(file) => file,
            Err(error) => {
                if !is_absent(&error) {
                    self.note_unreadable(&entry, &error);
                }
                return None;
            }
        };
        match taken(&file) {
            Ok(Some(value)) => return Some(value),
            Ok(None) => self.discard(key, "its content has changed since it was written"),
            Err(error) => self.note_unreadable(&entry, &error),
        }
        None
    }

    /// Stores `value` under `key`.
    pub(super) fn keep_value(&self, key: &Key, value: &impl Kept) {
        if value.to_kept().is_none() {
            return;
        }
        let kept = || value.to_kept().ok_or(io::ErrorKind::Unsupported);
        self.put(key, |beside| {
            let mut file = File::create_new(beside)?;
            writeln!(file, "{}", Digest::of_reader(&mut kept()?)?)?;
            io::copy(&mut kept()?, &mut file)?;
            // A name that survives a power cut must not refer to an empty file.
            file.sync_all()
        });
    }
}

/// Reads the value in a file; `None` unless the digest in the first line matches the remaining content.
fn taken<T: Kept>(mut file: &File) -> io::Result<Option<T>> {
    let length = usize::try_from(file.metadata()?.len()).unwrap_or(usize::MAX);
    let Some(length) = length.checked_sub(FIRST_LINE) else {
        return Ok(None);
    };
    let mut line = [0; FIRST_LINE];
    file.read_exact(&mut line)?;
    let line = str::from_utf8(&line).ok();
    let digest = line.and_then(|line| line.strip_suffix('\n')?.parse::<Digest>().ok());
    if digest != Some(Digest::of_reader(&mut file)?) {
        return Ok(None);
    }
    file.seek(SeekFrom::Start(FIRST_LINE as u64))?;
    Ok(T::from_kept(BufReader::new(file), length))
}

/// True if the error means that the entry or its folder does not exist.
fn is_absent(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory
    )
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::CachedStage;
    use super::*;

    /// Test column with one undefined value.
    fn numbers() -> Column {
        let mut column = Column::default();
        for value in [Some(0.1), None, Some(-0.0), Some(1e300)] {
            column.push(value);
        }
        column
    }

    #[test]
    fn what_is_kept_is_found_with_the_same_bits() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::new(folder.path().join("deep/cache"), String::new());
        let key = Key::of(CachedStage::Predict).finish();
        assert_eq!(cache.take_value::<Column>(&key), None);
        cache.keep_value(&key, &numbers());
        let found: Column = cache.take_value(&key).expect("kept");
        let bits = |column: &Column| -> Vec<_> {
            let rows = (0..column.len()).map(|row| column.get(row).map(f64::to_bits));
            rows.collect()
        };
        assert_eq!(bits(&found), bits(&numbers()));
        assert_eq!(cache.notes(), Vec::<String>::new());
        let other = Key::of(CachedStage::Predict).part("seed", "2").finish();
        assert_eq!(cache.take_value::<Column>(&other), None);
    }

    #[test]
    fn nothing_half_written_and_nothing_altered_is_ever_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let key = Key::of(CachedStage::Classify).finish();
        let cache = Cache::new(folder.path().to_owned(), String::new());
        cache.keep_value(&key, &numbers());
        let entry = cache.entry(&key);
        let whole = fs::read(&entry).expect("kept");
        for length in 0..whole.len() {
            fs::write(&entry, &whole[..length]).expect("cut");
            assert_eq!(cache.take_value::<Column>(&key), None, "{length} bytes");
            assert!(!entry.exists(), "{length} bytes are removed");
        }
        for position in 0..whole.len() {
            let mut altered = whole.clone();
            altered[position] ^= 1;
            fs::write(&entry, altered).expect("altered");
            assert_eq!(cache.take_value::<Column>(&key), None, "byte {position}");
        }
        assert!(cache.notes()[0].contains("its content has changed"));
        cache.keep_value(&key, &numbers());
        assert_eq!(cache.take_value(&key), Some(numbers()));
    }

    #[test]
    fn a_folder_that_cannot_be_written_is_noted_once_and_stops_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("file");
        fs::write(&file, "mine").expect("written");
        let cache = Cache::new(file.clone(), String::new());
        for stage in [CachedStage::Fit, CachedStage::Predict] {
            let key = Key::of(stage).finish();
            assert_eq!(cache.take_value::<Column>(&key), None);
            cache.keep_value(&key, &numbers());
        }
        let notes = cache.notes();
        assert!(
            matches!(&notes[..], [note] if note.contains("cannot write to the cache")),
            "{notes:?}"
        );
        assert_eq!(fs::read(&file).expect("there"), b"mine");
    }

    #[test]
    fn of_two_that_keep_one_thing_at_once_either_is_found_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let key = Key::of(CachedStage::Classify).finish();
        let cache = Cache::new(folder.path().to_owned(), String::new());
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for _ in 0..20 {
                        cache.keep_value(&key, &numbers());
                        assert_eq!(cache.take_value(&key), Some(numbers()));
                    }
                });
            }
        });
        assert_eq!(cache.notes(), Vec::<String>::new());
    }
}
