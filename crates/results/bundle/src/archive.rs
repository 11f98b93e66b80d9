//! A bundle as one file: `.tar.gz` with sorted names, time stamps of 0 and no owner.

use std::cell::Cell;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Write};
use std::path::Path;
use std::rc::Rc;

use flate2::Compression;
use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;
use taceva_core::shown;
use tar::{Archive, Builder, EntryType, Header};

use crate::error::{BundleError, Damage};
use crate::layout::{GROWTH, GROWTH_BYTES};
use crate::name::{self, check_amount, check_case};

/// First bytes of a packed file.
const GZIP: [u8; 2] = [0x1f, 0x8b];
/// Rule for the entries of a packed bundle.
const ENTRIES: &str = "a packed bundle holds only regular files";
/// Rule for the packed file as a whole.
const WHOLE: &str = "a packed bundle is one complete .tar.gz";

/// Packs the files `names` of the folder `root`, sorted by name, into a new file at `path`. Equal files give equal bytes.
///
/// # Errors
/// [`io::Error`] if a file cannot be read or written.
pub(crate) fn pack(root: &Path, names: &[String], path: &Path) -> io::Result<()> {
    let file = BufWriter::new(File::create_new(path)?);
    let mut archive = Builder::new(GzEncoder::new(file, Compression::best()));
    for name in names {
        let content = File::open(root.join(name))?;
        let mut header = Header::new_ustar();
        header.set_path(name)?;
        header.set_entry_type(EntryType::Regular);
        header.set_size(content.metadata()?.len());
        header.set_mode(0o644);
        header.set_uid(0);
        header.set_gid(0);
        header.set_mtime(0);
        header.set_cksum();
        archive.append(&header, content)?;
    }
    let mut file = archive.into_inner()?.finish()?;
    file.flush()
}

/// Unpacks the bundle at `path` into the empty folder `into`. Unpacks at most `most` bytes, and at most [`GROWTH`] times the packed size plus
/// [`GROWTH_BYTES`].
///
/// # Errors
/// [`BundleError::Damaged`] for a refused entry: a link, a device, a repeated name, or a name outside the bundle.
/// Too many files or bytes, and a file that is not a `.tar.gz`, give the same error.
pub(crate) fn unpack(path: &Path, into: &Path, most: u64) -> Result<(), BundleError> {
    // Checks before opening: opening a pipe would block until it has a writer.
    let about = fs::metadata(path).map_err(BundleError::file(path))?;
    if !about.is_file() {
        let problem = "not a regular file, expected a folder or a .tar.gz";
        return Err(damaged(".", problem));
    }
    let file = File::open(path).map_err(BundleError::file(path))?;
    let mut file = BufReader::new(file);
    let start = file.fill_buf().map_err(BundleError::file(path))?;
    if !start.starts_with(&GZIP) {
        let rule = "a bundle is a folder or a .tar.gz";
        let problem = "not a bundle: expected a folder or a .tar.gz that `taceva bundle` wrote";
        let damage = Damage::new(&path.to_string_lossy(), rule, problem);
        return Err(BundleError::Damaged(damage));
    }
    let allowed = about
        .len()
        .saturating_mul(GROWTH)
        .saturating_add(GROWTH_BYTES);
    let allowed = allowed.min(most);
    let is_beyond = Rc::new(Cell::new(false));
    let reader = Capped {
        decoder: MultiGzDecoder::new(file),
        left: allowed,
        is_beyond: Rc::clone(&is_beyond),
    };
    unpack_all(Archive::new(reader), into, most).map_err(|fault| match fault {
        Fault::Refused(error) => error,
        Fault::Read(_) if is_beyond.get() => damaged(
            ".",
            &format!(
                "more than {allowed} bytes unpacked, the limit for a file of {} bytes",
                about.len()
            ),
        ),
        Fault::Read(error) => {
            let problem = format!("not a complete .tar.gz: {error}");
            BundleError::Damaged(Damage::new(".", WHOLE, problem))
        }
        Fault::Write(error) => {
            let problem = format!(
                "cannot be unpacked into {}: {error}; set TMPDIR to another folder",
                shown(into)
            );
            BundleError::input(path, problem)
        }
    })
}

/// Reason why unpacking stopped.
enum Fault {
    Refused(BundleError),
    Read(io::Error),
    /// The copy of an entry cannot be written, as on a full disk.
    Write(io::Error),
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Fault {
        Fault::Read(error)
    }
}

impl From<BundleError> for Fault {
    fn from(error: BundleError) -> Fault {
        Fault::Refused(error)
    }
}

fn unpack_all(mut archive: Archive<Capped>, into: &Path, most: u64) -> Result<(), Fault> {
    let mut names: Vec<String> = Vec::new();
    let mut total = 0_u64;
    // Reads raw entries, so that entries with long names are refused too.
    for entry in archive.entries()?.raw(true) {
        let mut entry = entry?;
        let name = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
        let kind = entry.header().entry_type();
        let own = name.strip_prefix("./").unwrap_or(&name);
        if kind == EntryType::Directory {
            let folder = own.trim_end_matches('/');
            if !folder.is_empty()
                && let Some(fault) = name::fault(folder)
            {
                return Err(damaged(folder, &fault).into());
            }
            let size = entry.header().size()?;
            if size > 0 {
                let problem = format!("a folder with {size} bytes of content, expected none");
                return Err(damaged(folder, &problem).into());
            }
            continue;
        }
        if let Some(fault) = name::fault(own) {
            return Err(BundleError::Damaged(Damage::new(own, name::RULE, fault)).into());
        }
        if kind != EntryType::Regular {
            let what = match kind {
                EntryType::Symlink | EntryType::Link => "a link",
                EntryType::XHeader | EntryType::XGlobalHeader | EntryType::GNULongName => {
                    "a header extension, such as for a long name"
                }
                _ => "a special file",
            };
            return Err(damaged(own, &format!("{what}, expected a regular file")).into());
        }
        let size = entry.header().size()?;
        total = total.saturating_add(size);
        names.push(own.to_owned());
        check_amount(names.len(), total, most)?;
        let path = into.join(own);
        if let Some(folder) = path.parent() {
            match fs::create_dir_all(folder) {
                Err(error) if is_taken(&error) => {
                    return Err(damaged(own, "a file has the name of its folder").into());
                }
                made => made.map_err(BundleError::file(folder))?,
            }
        }
        let created = OpenOptions::new().write(true).create_new(true).open(&path);
        let mut file = match created {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                return Err(damaged(own, "the file occurs twice, expected once").into());
            }
            created => created.map_err(BundleError::file(&path))?,
        };
        let copied = copy(&mut entry, &mut file)?;
        if copied != size {
            return Err(damaged(own, &format!("{copied} bytes, expected {size}")).into());
        }
    }
    check_case(names.iter())?;
    // Rejects bytes after the packed data, because other programs would unpack files from them.
    if has_more(archive.into_inner())? {
        return Err(damaged(
            ".",
            "bytes after the end of the archive, expected only zeros",
        )
        .into());
    }
    Ok(())
}

/// Copies `from` to its end. Returns the number of bytes. An error of `into` is not a fault of the archive.
fn copy(from: &mut impl Read, into: &mut impl Write) -> Result<u64, Fault> {
    let (mut block, mut copied) = (vec![0; 1 << 16], 0);
    loop {
        let read = match from.read(&mut block) {
            Ok(0) => return Ok(copied),
            Ok(read) => read,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(Fault::Read(error)),
        };
        into.write_all(&block[..read]).map_err(Fault::Write)?;
        copied += read as u64;
    }
}

/// True if `rest`, read to its end, contains a byte other than 0.
fn has_more(mut rest: impl Read) -> io::Result<bool> {
    let (mut block, mut has_more) = (vec![0; 1 << 16], false);
    loop {
        match rest.read(&mut block)? {
            0 => return Ok(has_more),
            read => has_more |= block[..read].iter().any(|byte| *byte != 0),
        }
    }
}

/// True if a folder cannot be created because a file has its name.
fn is_taken(error: &io::Error) -> bool {
    let kind = error.kind();
    kind == io::ErrorKind::AlreadyExists || kind == io::ErrorKind::NotADirectory
}

fn damaged(path: &str, problem: &str) -> BundleError {
    BundleError::Damaged(Damage::new(path, ENTRIES, problem))
}

/// Reader of the unpacked bytes of a packed bundle, up to a limit.
struct Capped {
    decoder: MultiGzDecoder<BufReader<File>>,
    left: u64,
    is_beyond: Rc<Cell<bool>>,
}

impl Read for Capped {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let read = self.decoder.read(into)?;
        match self.left.checked_sub(read as u64) {
            Some(left) => self.left = left,
            None => {
                self.is_beyond.set(true);
                return Err(io::Error::other("too many bytes"));
            }
        }
        Ok(read)
    }
}

#[cfg(test)]
mod tests;
