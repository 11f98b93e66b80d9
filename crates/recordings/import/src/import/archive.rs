//! A recording that came as a tar archive.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;

use crate::foreign::tar::{FileTape, Members, Tape, TarError};
use taceva_dataset::internal::{open_regular, shown_path};
use taceva_dataset::{DatasetError, Place};
use taceva_files::TemporaryFolder;

/// How many times as large as its file a compressed archive may be, and how many bytes more.
const GROWTH: u64 = 128;
const GROWTH_BYTES: u64 = 64 << 20;
/// Begin of the name of the folder that it is unpacked into.
const PREFIX: &str = ".taceva-unpacked-";
/// The first bytes of a gzip file.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// A `.tar` or `.tar.gz` whose files are unpacked into a hidden folder, which is removed with it.
///
/// Every reader of a recording opens files by their paths and seeks in them, and maps name further files: in an archive none of that is possible
/// without holding it in memory. Shards of WebDataset are the exception: they are read where they lie.
///
/// ```no_run
/// use taceva_import::{MapDraft, UnpackedArchive};
///
/// let archive = UnpackedArchive::open("run.tar.gz".as_ref(), "/tmp".as_ref())?;
/// println!("{}", MapDraft::of(archive.folder())?.text());
/// # Ok::<(), taceva_dataset::DatasetError>(())
/// ```
#[derive(Debug)]
pub struct UnpackedArchive {
    folder: PathBuf,
    archive: PathBuf,
    /// Folder of the unpacked files, within `temporary`.
    content: PathBuf,
    /// Removed with the archive.
    _temporary: TemporaryFolder,
}

impl UnpackedArchive {
    /// Whether `path` is a file whose name ends in `.tar`, `.tar.gz` or `.tgz`.
    ///
    /// ```
    /// assert!(!taceva_import::UnpackedArchive::is_archive("no/such/file.tar".as_ref()));
    /// ```
    pub fn is_archive(path: &Path) -> bool {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let name = name.to_ascii_lowercase();
        path.is_file()
            && [".tar", ".tar.gz", ".tgz"]
                .iter()
                .any(|ending| name.ends_with(ending))
    }

    /// Unpacks the archive into a hidden folder in the folder `beside`, whose name nobody can foretell; what killed imports left there is removed.
    ///
    /// Of an archive, one header and one name are in memory at a time. If everything in it lies in one folder, that is the recording.
    ///
    /// # Errors
    /// [`DatasetError::Table`] naming the member if it is damaged or cut, if a name leaves the folder, of links, devices and sparse files, of a
    /// size that is not there, above a million members, and of a compressed archive that grows beyond 128 times its size and 64 MiB more;
    /// [`DatasetError::Io`] if the disk is full.
    pub fn open(archive: &Path, beside: &Path) -> Result<UnpackedArchive, DatasetError> {
        let temporary = TemporaryFolder::create(beside, PREFIX);
        let temporary = temporary.map_err(DatasetError::io("make a folder in", beside))?;
        let content = temporary.path().join("content");
        fs::create_dir(&content).map_err(DatasetError::io("create", &content))?;
        let (mut file, length) = open_regular(archive, u64::MAX)?;
        let mut first = [0; 2];
        let is_packed = file.read_exact(&mut first).is_ok() && first == GZIP;
        io::Seek::rewind(&mut file).map_err(DatasetError::io("read", archive))?;
        let file = BufReader::new(file);
        let outcome = match is_packed {
            true => unpack(
                PackedTape {
                    decoder: MultiGzDecoder::new(file),
                    left: length.saturating_mul(GROWTH).saturating_add(GROWTH_BYTES),
                },
                &content,
            ),
            false => unpack(FileTape { file, length }, &content),
        };
        outcome.map_err(|error| DatasetError::Table {
            place: Place::file(archive),
            problem: error.to_string(),
        })?;
        Ok(UnpackedArchive {
            folder: innermost(&content)?,
            archive: archive.to_owned(),
            content,
            _temporary: temporary,
        })
    }

    /// The same error, in whose paths the archive and its member stand and not where they were unpacked: `run.tar/run/labels.csv`.
    ///
    /// ```no_run
    /// # use taceva_import::{MapDraft, UnpackedArchive};
    /// # let archive = UnpackedArchive::open("run.tar".as_ref(), "/tmp".as_ref())?;
    /// let draft = MapDraft::of(archive.folder()).map_err(|error| archive.named(error))?;
    /// # Ok::<(), taceva_dataset::DatasetError>(())
    /// ```
    #[must_use]
    pub fn named(&self, error: DatasetError) -> DatasetError {
        let unpacked = &self.content;
        error.with_paths(
            &|path| {
                path.strip_prefix(unpacked)
                    .map_or_else(|_| path.to_owned(), |member| self.archive.join(member))
            },
            &|text| self.text_named(text),
        )
    }

    /// The same text, in which the archive stands and not where it was unpacked.
    ///
    /// ```no_run
    /// # let archive = taceva_import::UnpackedArchive::open("run.tar".as_ref(), "/tmp".as_ref())?;
    /// let said = format!("{} holds 3 tables", archive.folder().display());
    /// assert!(archive.text_named(&said).starts_with("run.tar"));
    /// # Ok::<(), taceva_dataset::DatasetError>(())
    /// ```
    pub fn text_named(&self, text: &str) -> String {
        let [unpacked, archive] = [&self.content, &self.archive]
            .map(PathBuf::as_path)
            .map(shown_path);
        text.replace(&unpacked, &archive)
    }

    /// Where its files lie.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

fn unpack(tape: impl Tape, into: &Path) -> Result<(), TarError> {
    let mut members = Members::new(tape);
    while let Some(member) = members.next()? {
        let path = into.join(&member.name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent)?;
        }
        let created = OpenOptions::new().write(true).create_new(true).open(&path);
        let mut file = match created {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                return Err(TarError::Twice(member.name));
            }
            created => created?,
        };
        members.copy(&member, &mut file)?;
    }
    // The checksum of what is packed stands behind its end.
    io::copy(&mut members.into_tape(), &mut io::sink())?;
    Ok(())
}

/// The folder, or the only folder in it, if nothing lies beside that.
fn innermost(folder: &Path) -> Result<PathBuf, DatasetError> {
    let mut folder = folder.to_owned();
    loop {
        let mut entries = fs::read_dir(&folder)
            .map_err(DatasetError::io("list", &folder))?
            .flatten();
        match (entries.next(), entries.next()) {
            (Some(only), None) if only.path().is_dir() => folder = only.path(),
            _ => return Ok(folder),
        }
    }
}

/// A compressed archive, of which no more is read than it may hold.
struct PackedTape {
    decoder: MultiGzDecoder<BufReader<File>>,
    left: u64,
}

impl Read for PackedTape {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let read = self.decoder.read(into)?;
        self.left = self.left.checked_sub(read as u64).ok_or_else(|| {
            io::Error::other(format!("unpacked it is more than {GROWTH} times as large as its file, which is not accepted: gunzip it first"))
        })?;
        Ok(read)
    }
}

impl Tape for PackedTape {
    fn skip(&mut self, bytes: u64) -> io::Result<bool> {
        let skipped = io::copy(&mut self.by_ref().take(bytes), &mut io::sink())?;
        Ok(skipped == bytes)
    }

    fn length(&self) -> Option<u64> {
        None
    }
}
