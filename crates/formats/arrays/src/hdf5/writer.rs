//! Writer of HDF5 files with contiguous arrays, one after another. Rows are written to the disk as they arrive. The metadata follows at the end.
//!
//! `hdf5-pure` is used for reading only. Its writer accepts an array of several axes only in memory, and a recording of pictures is larger. The
//! output uses a minimum of version 3 of the HDF5 File Format Specification. The superblock and object headers have version 2 and checksums. Links
//! are in the header of the root group. Every HDF5 library since 1.8 reads this format.

use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::element_type::WrittenElement;
use super::structures::{
    Heap, NOWHERE, SUPERBLOCK_BYTES, attribute, contiguous, dataspace, header, link, superblock,
};
use crate::error::{ArrayError, Problem};

/// Maximum size of the text of an attribute, bytes.
const TEXT_BYTES: usize = 1 << 20;

/// Writer of an HDF5 file.
///
/// ```
/// use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues, Hdf5Writer, WrittenElement};
///
/// # let path = std::env::temp_dir().join(format!("taceva-written-{}.h5", std::process::id()));
/// let mut writer = Hdf5Writer::create(&path)?;
/// writer.begin("force", WrittenElement::F32, &[2, 3], &[("unit", "N")])?;
/// for row in [[0.0_f32, 0.5, 2.0], [0.25, 0.5, 2.5]] {
///     writer.write(&row.map(f32::to_le_bytes).concat())?;
/// }
/// writer.finish(&[("made by", "an example")])?;
///
/// let file = ArrayFile::open(&path, ArrayFormat::Hdf5)?;
/// assert_eq!(file.read("force", 1..2)?.values, ArrayValues::F32(vec![0.25, 0.5, 2.5]));
/// assert_eq!(file.attribute("force", "unit").as_deref(), Some("N"));
/// # std::fs::remove_file(&path).ok();
/// # Ok::<(), taceva_arrays::ArrayError>(())
/// ```
#[derive(Debug)]
pub struct Hdf5Writer {
    path: PathBuf,
    file: BufWriter<File>,
    at: u64,
    /// Written arrays. The last array may be incomplete.
    arrays: Vec<Written>,
}

/// Array in the file under construction.
#[derive(Debug)]
struct Written {
    name: String,
    element: WrittenElement,
    shape: Vec<u64>,
    attributes: Vec<(String, String)>,
    at: u64,
    bytes: u64,
}

impl Hdf5Writer {
    /// Creates the file at `path`.
    ///
    /// # Errors
    /// [`Problem::Io`] if the file exists already or cannot be created.
    pub fn create(path: &Path) -> Result<Hdf5Writer, ArrayError> {
        let begun = File::create_new(path).and_then(|file| {
            let mut file = BufWriter::new(file);
            // A file of a killed process has no signature. Readers do not take it for a complete file.
            file.write_all(&[0; SUPERBLOCK_BYTES])?;
            Ok(file)
        });
        let file = begun.map_err(|source| failed(path, None, Problem::io("create")(source)))?;
        Ok(Hdf5Writer {
            path: path.to_owned(),
            file,
            at: SUPERBLOCK_BYTES as u64,
            arrays: Vec::new(),
        })
    }

    /// Begins the array `name`, with texts as its attributes. The previous array must be complete.
    ///
    /// # Errors
    /// [`Problem::Damaged`] if the previous array is incomplete. [`Problem::Unsupported`] for an invalid or duplicate name, a size above 64 bits,
    /// or an attribute above 1 MiB. [`Problem::Io`] if the file cannot be written.
    pub fn begin(
        &mut self,
        name: &str,
        element: WrittenElement,
        shape: &[u64],
        attributes: &[(&str, &str)],
    ) -> Result<(), ArrayError> {
        self.check_whole()?;
        let unsupported = |found: &str, mend: &str| {
            failed(&self.path, Some(name), Problem::unsupported(found, mend))
        };
        let is_taken = self.arrays.iter().any(|array| array.name == name);
        if name.is_empty() || name.len() > 255 || name.contains(['/', '\0']) || is_taken {
            return Err(unsupported(
                "an invalid name of an array",
                "use a unique name of up to 255 bytes without `/`",
            ));
        }
        let bytes = shape
            .iter()
            .try_fold(u64::from(element.bytes()), |bytes, side| {
                bytes.checked_mul(*side)
            });
        let bytes =
            bytes.ok_or_else(|| unsupported("a shape that exceeds 64 bits", "write fewer rows"))?;
        if attributes
            .iter()
            .any(|(key, text)| key.len() > 255 || text.len() > TEXT_BYTES)
        {
            return Err(unsupported(
                "an attribute longer than 1 MiB",
                "write an array of strings",
            ));
        }
        // Elements are aligned to their size.
        let padded = self.pad();
        padded.map_err(|source| failed(&self.path, Some(name), Problem::io("write")(source)))?;
        self.arrays.push(Written {
            name: name.to_owned(),
            element,
            shape: shape.to_vec(),
            attributes: owned(attributes),
            at: self.at,
            bytes,
        });
        Ok(())
    }

    /// Writes the next elements of the current array, little-endian and in C order.
    ///
    /// # Errors
    /// [`Problem::Damaged`] if there are more elements than the shape allows. [`Problem::Io`] if the file cannot be written.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), ArrayError> {
        let left = self.left();
        if bytes.len() as u64 > left {
            return Err(self.not_all(left as i128 - bytes.len() as i128));
        }
        let written = self.file.write_all(bytes);
        written.map_err(|source| failed(&self.path, None, Problem::io("write")(source)))?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// Ends the file, with texts as attributes of the root group. Syncs the content of the file to the disk, but not its folder entry.
    ///
    /// # Errors
    /// [`Problem::Damaged`] if the last array is incomplete. [`Problem::Io`] if the file cannot be written.
    pub fn finish(mut self, attributes: &[(&str, &str)]) -> Result<(), ArrayError> {
        self.check_whole()?;
        let path = self.path.clone();
        let ended = self.end(&owned(attributes));
        ended.map_err(|source| failed(&path, None, Problem::io("write")(source)))
    }

    fn end(&mut self, attributes: &[(String, String)]) -> io::Result<()> {
        let arrays = std::mem::take(&mut self.arrays);
        self.pad()?;
        let heap_at = self.at;
        let mut heap = Heap::default();
        let mut texts = |attributes: &[(String, String)]| -> Vec<(u8, Vec<u8>)> {
            let each = attributes.iter();
            each.map(|(key, text)| attribute(key, text.len(), heap_at, heap.add(text)))
                .collect()
        };
        let of_arrays: Vec<Vec<(u8, Vec<u8>)>> = arrays
            .iter()
            .map(|array| texts(&array.attributes))
            .collect();
        let of_root = texts(attributes);
        if heap.count > 0 {
            self.put(&heap.collection())?;
        }
        let mut root = vec![
            // Link info: links are here and not in a heap. Group info: defaults.
            (
                0x02,
                [&[0, 0][..], &NOWHERE.to_le_bytes(), &NOWHERE.to_le_bytes()].concat(),
            ),
            (0x0a, vec![0, 0]),
        ];
        for (array, attributes) in arrays.iter().zip(of_arrays) {
            let mut messages = vec![
                (0x01, dataspace(&array.shape)),
                (0x03, array.element.message()),
                // Fill value: late allocation, written if set. None is set.
                (0x05, vec![3, 0x0a]),
                (0x08, contiguous(array.at, array.bytes)),
            ];
            messages.extend(attributes);
            let at = self.at;
            self.put(&header(&messages))?;
            root.push((0x06, link(&array.name, at)));
        }
        root.extend(of_root);
        let at = self.at;
        self.put(&header(&root))?;
        let superblock = superblock(self.at, at);
        self.file.flush()?;
        let file = self.file.get_mut();
        // The signature is written after all other bytes are on the disk.
        file.sync_all()?;
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&superblock)?;
        file.sync_all()
    }

    /// Pads the file to a multiple of eight bytes.
    fn pad(&mut self) -> io::Result<()> {
        let padding = usize::try_from(self.at.next_multiple_of(8) - self.at).unwrap_or(0);
        self.put(&[0; 8][..padding])
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// Number of bytes that the caller must still write to complete the last array.
    fn left(&self) -> u64 {
        self.arrays
            .last()
            .map_or(0, |array| array.at + array.bytes - self.at)
    }

    fn check_whole(&self) -> Result<(), ArrayError> {
        match self.left() {
            0 => Ok(()),
            left => Err(self.not_all(left.into())),
        }
    }

    /// Error for a last array that got too few or too many bytes; `missing` is negative for excess bytes.
    fn not_all(&self, missing: i128) -> ArrayError {
        let array = self.arrays.last();
        let whole = array.map_or(0, |array| array.bytes);
        let given = i128::from(whole) - missing;
        failed(
            &self.path,
            array.map(|array| array.name.as_str()),
            Problem::damaged(
                0,
                format!("{given} bytes given"),
                format!("{whole} for its shape and type"),
            ),
        )
    }
}

fn owned(attributes: &[(&str, &str)]) -> Vec<(String, String)> {
    let each = attributes.iter();
    each.map(|(key, text)| ((*key).to_owned(), (*text).to_owned()))
        .collect()
}

fn failed(path: &Path, array: Option<&str>, problem: Problem) -> ArrayError {
    ArrayError {
        path: path.to_owned(),
        array: array.map(str::to_owned),
        problem,
    }
}
