//! Unpacks recordings in a tar archive.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::MultiGzDecoder;
use taceva_core::Progress;

use crate::error::ImportError;
use crate::foreign::tar::{FileTape, Members, Tape, TarError};
use taceva_dataset::DatasetError;
use taceva_dataset::internal::{open_regular, shown_path};
use taceva_files::TemporaryFolder;

/// Limit of the unpacked size of a compressed archive, bytes: `GROWTH` times the packed size, plus `GROWTH_BYTES`.
const GROWTH: u64 = 128;
const GROWTH_BYTES: u64 = 64 << 20;
/// Name prefix of the folder of unpacked files.
const PREFIX: &str = ".taceva-unpacked-";
/// The first bytes of a gzip file.
const GZIP: [u8; 2] = [0x1f, 0x8b];

/// Unpacked `.tar` or `.tar.gz`. The files are in a hidden folder that is removed on drop.
///
/// Readers of recordings open files by path and seek in them, and maps name further files. Reading them inside the archive would need the whole archive in
/// memory. WebDataset shards are an exception, because they can be read in place.
///
/// ```no_run
/// use taceva_import::{MapDraft, UnpackedArchive};
///
/// let progress = taceva_core::SilentProgress;
/// let archive = UnpackedArchive::open("run.tar.gz".as_ref(), "/tmp".as_ref(), &progress)?;
/// println!("{}", MapDraft::of(archive.folder())?.text());
/// # Ok::<(), taceva_import::ImportError>(())
/// ```
#[derive(Debug)]
pub struct UnpackedArchive {
    folder: PathBuf,
    archive: PathBuf,
    /// Folder of the unpacked files, within `temporary`.
    content: PathBuf,
    /// Temporary folder, removed on drop.
    _temporary: TemporaryFolder,
}

impl UnpackedArchive {
    /// True if `path` is a file whose name ends in `.tar`, `.tar.gz` or `.tgz`.
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

    /// Unpacks the archive into a hidden folder with an unpredictable name in `beside`. Removes leftovers of killed imports in `beside`.
    ///
    /// Needs memory for one header and one name. If the archive has a single folder at its top, that folder is the recording.
    ///
    /// # Errors
    /// [`ImportError::Table`] naming the member if it is damaged, truncated or larger than the archive, or if its name leads out of the folder. The
    /// same error occurs for links, devices, sparse files and more than a million members. A compressed archive may unpack to at most 128 times its
    /// size plus 64 MiB. [`ImportError::Dataset`] if the disk is full, or `Cancelled`.
    pub fn open(
        archive: &Path,
        beside: &Path,
        progress: &dyn Progress,
    ) -> Result<UnpackedArchive, ImportError> {
        let temporary = TemporaryFolder::create(beside, PREFIX);
        let temporary = temporary.map_err(unusable(beside))?;
        let content = temporary.path().join("content");
        fs::create_dir(&content).map_err(ImportError::io("create", &content))?;
        let (mut file, length) = open_regular(archive, u64::MAX)?;
        let mut first = [0; 2];
        let is_packed = file.read_exact(&mut first).is_ok() && first == GZIP;
        io::Seek::rewind(&mut file).map_err(ImportError::io("read", archive))?;
        let file = BufReader::new(file);
        let outcome = match is_packed {
            true => unpack(
                PackedTape {
                    decoder: MultiGzDecoder::new(file),
                    left: length.saturating_mul(GROWTH).saturating_add(GROWTH_BYTES),
                },
                &content,
                progress,
            ),
            false => unpack(FileTape { file, length }, &content, progress),
        };
        if progress.is_cancelled() {
            return Err(DatasetError::Cancelled.into());
        }
        outcome.map_err(|error| match error {
            TarError::Read(error) if is_of_disk(error.kind()) => unusable(beside)(error),
            error => ImportError::table(archive, error.to_string()),
        })?;
        Ok(UnpackedArchive {
            folder: innermost(&content)?,
            archive: archive.to_owned(),
            content,
            _temporary: temporary,
        })
    }

    /// The same error with paths in the archive instead of the temporary folder: `run.tar/run/labels.csv`.
    ///
    /// ```no_run
    /// # use taceva_import::{MapDraft, UnpackedArchive};
    /// # let archive = UnpackedArchive::open("run.tar".as_ref(), "/tmp".as_ref(), &taceva_core::SilentProgress)?;
    /// let draft = MapDraft::of(archive.folder()).map_err(|error| archive.named(error))?;
    /// # Ok::<(), taceva_import::ImportError>(())
    /// ```
    #[must_use]
    pub fn named(&self, error: ImportError) -> ImportError {
        let unpacked = &self.content;
        error.with_paths(
            &|path| {
                path.strip_prefix(unpacked)
                    .map_or_else(|_| path.to_owned(), |member| self.archive.join(member))
            },
            &|text| self.text_named(text),
        )
    }

    /// The same text with the path of the archive instead of the temporary folder.
    ///
    /// ```no_run
    /// # let archive = taceva_import::UnpackedArchive::open("run.tar".as_ref(), "/tmp".as_ref(), &taceva_core::SilentProgress)?;
    /// let said = format!("{} holds 3 tables", archive.folder().display());
    /// assert!(archive.text_named(&said).starts_with("run.tar"));
    /// # Ok::<(), taceva_import::ImportError>(())
    /// ```
    pub fn text_named(&self, text: &str) -> String {
        let [unpacked, archive] = [&self.content, &self.archive]
            .map(PathBuf::as_path)
            .map(shown_path);
        text.replace(&unpacked, &archive)
    }

    /// Folder of the unpacked recording.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

/// Error for a folder in which no files can be created, with the remedy.
fn unusable(beside: &Path) -> impl FnOnce(io::Error) -> ImportError {
    let refused = ImportError::io("unpack into", beside);
    move |error| {
        let problem = format!(
            "{error}; name another folder, with room for the content of the archive, by --out or TMPDIR"
        );
        refused(io::Error::new(error.kind(), problem))
    }
}

/// True if a write failed because the disk is full or read-only, or because the file exceeds a limit.
fn is_of_disk(kind: io::ErrorKind) -> bool {
    use io::ErrorKind::{FileTooLarge, QuotaExceeded, ReadOnlyFilesystem, StorageFull};
    matches!(
        kind,
        FileTooLarge | QuotaExceeded | ReadOnlyFilesystem | StorageFull
    )
}

/// Unpacks all members. Stops early if the work is cancelled.
fn unpack(tape: impl Tape, into: &Path, progress: &dyn Progress) -> Result<(), TarError> {
    let mut members = Members::new(tape);
    while let Some(member) = members.next()? {
        if progress.is_cancelled() {
            return Ok(());
        }
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
    // The checksum of the compressed data follows its end.
    io::copy(&mut members.into_tape(), &mut io::sink())?;
    Ok(())
}

/// Descends into the only subfolder of `folder` while there is no other entry. Returns the last folder.
fn innermost(folder: &Path) -> Result<PathBuf, ImportError> {
    let mut folder = folder.to_owned();
    loop {
        let mut entries = fs::read_dir(&folder)
            .map_err(ImportError::io("list", &folder))?
            .flatten();
        match (entries.next(), entries.next()) {
            (Some(only), None) if only.path().is_dir() => folder = only.path(),
            _ => return Ok(folder),
        }
    }
}

/// Compressed archive, read up to its size limit.
struct PackedTape {
    decoder: MultiGzDecoder<BufReader<File>>,
    left: u64,
}

impl Read for PackedTape {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let read = self.decoder.read(into)?;
        self.left = self.left.checked_sub(read as u64).ok_or_else(|| {
            io::Error::other(format!("the unpacked archive is more than {GROWTH} times as large as its file, expected less: gunzip it first"))
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
