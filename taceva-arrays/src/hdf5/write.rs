//! Files of HDF5 written an array after another, each in one piece: rows go to the disk as they come, what describes them stands at the end.
//!
//! `hdf5-pure` reads here and does not write: an array of several axes it takes from memory alone, and a recording of pictures is larger. Written is the
//! least that the format asks: superblock 2, object headers 2 with their checksums, links in the header of the root group (HDF5 File Format
//! Specification, version 3). Every library since 1.8 reads it.

use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::lookup3::lookup3;
use crate::error::{ArrayError, Problem};

/// Bytes of the superblock, behind which the first array begins.
const SUPERBLOCK_BYTES: u64 = 48;
/// An address that nothing has.
const NOWHERE: u64 = u64::MAX;
/// The longest text of an attribute, bytes.
const TEXT_BYTES: usize = 1 << 20;

/// What the elements of a written array are, little endian.
///
/// ```
/// use taceva_arrays::WrittenElement;
/// assert_eq!(WrittenElement::Text { bytes: 12 }.bytes(), 12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WrittenElement {
    /// Whole numbers from 0, of 8 bits.
    U8,
    /// Whole numbers from 0, of 16 bits.
    U16,
    /// Whole numbers with a sign, of 64 bits.
    I64,
    /// Numbers of single precision.
    F32,
    /// Numbers of double precision; NaN where there is none.
    F64,
    /// Texts in UTF-8 of at most so many bytes, zeros behind shorter ones.
    Text {
        /// How many, at least 1.
        bytes: u32,
    },
}

impl WrittenElement {
    /// Bytes of one element.
    pub const fn bytes(self) -> u32 {
        match self {
            WrittenElement::U8 => 1,
            WrittenElement::U16 => 2,
            WrittenElement::F32 => 4,
            WrittenElement::I64 | WrittenElement::F64 => 8,
            WrittenElement::Text { bytes } => bytes,
        }
    }

    /// The message of the type.
    fn message(self) -> Vec<u8> {
        let size = self.bytes();
        let bits = u16::try_from(size.saturating_mul(8)).unwrap_or(u16::MAX);
        let mut message = Vec::new();
        let mut put = |class: u8, of_class: [u8; 3], rest: &[u8]| {
            // The version of the message, 1, stands above the class.
            message.push(0x10 | class);
            message.extend(of_class);
            message.extend(size.to_le_bytes());
            message.extend(rest);
        };
        let [low, high] = bits.to_le_bytes();
        let whole = [0, 0, low, high];
        // Bit offset and precision, place and width of exponent and mantissa, and the bias of the exponent.
        let single = [0, 0, low, high, 23, 8, 0, 23, 127, 0, 0, 0];
        let double = [0, 0, low, high, 52, 11, 0, 52, 0xff, 0x03, 0, 0];
        match self {
            WrittenElement::U8 | WrittenElement::U16 => put(0, [0, 0, 0], &whole),
            WrittenElement::I64 => put(0, [0x08, 0, 0], &whole),
            WrittenElement::F32 => put(1, [0x20, 31, 0], &single),
            WrittenElement::F64 => put(1, [0x20, 63, 0], &double),
            WrittenElement::Text { .. } => put(3, [0x11, 0, 0], &[]),
        }
        message
    }
}

/// A file of HDF5 while it is written.
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
    /// The arrays that are written, the last one perhaps in part.
    arrays: Vec<Written>,
}

/// An array of the file.
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
    /// Begins the new file at `path`.
    ///
    /// # Errors
    /// [`Problem::Io`] if it is there already, or cannot be made.
    pub fn create(path: &Path) -> Result<Hdf5Writer, ArrayError> {
        let begun = File::create_new(path).and_then(|file| {
            let mut file = BufWriter::new(file);
            // What a kill leaves has no signature, and nobody takes it for a whole file.
            file.write_all(&[0; SUPERBLOCK_BYTES as usize])?;
            Ok(file)
        });
        let file = begun.map_err(|source| failed(path, None, Problem::io("create")(source)))?;
        Ok(Hdf5Writer {
            path: path.to_owned(),
            file,
            at: SUPERBLOCK_BYTES,
            arrays: Vec::new(),
        })
    }

    /// Begins the array called `name`, with texts as its attributes; the one before has ended.
    ///
    /// # Errors
    /// [`Problem::Damaged`] if the array before has not all of its bytes; [`Problem::Unsupported`] of a name that is empty, taken or has `/`, of a
    /// shape beyond 64 bits, and of an attribute above 1 MiB; [`Problem::Io`].
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
                "a name that an array cannot have here",
                "write up to 255 bytes without `/`, each once",
            ));
        }
        let bytes = shape
            .iter()
            .try_fold(u64::from(element.bytes()), |bytes, side| bytes.checked_mul(*side));
        let bytes = bytes.ok_or_else(|| unsupported("a shape beyond 64 bits", "write fewer rows"))?;
        if attributes.iter().any(|(key, text)| key.len() > 255 || text.len() > TEXT_BYTES) {
            return Err(unsupported("an attribute longer than 1 MiB", "write an array of texts"));
        }
        // Elements lie where their size divides the place.
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

    /// Writes the next elements of the array that was begun last, little endian and the last axis fastest.
    ///
    /// # Errors
    /// [`Problem::Damaged`] if they are more than its shape says; [`Problem::Io`].
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

    /// Ends the file, with texts as attributes of its root, and waits until its bytes are on the disk; its name is not.
    ///
    /// # Errors
    /// [`Problem::Damaged`] if the last array has not all of its bytes; [`Problem::Io`].
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
            each.map(|(key, text)| attribute(key, text.len(), (heap_at, heap.add(text))))
                .collect()
        };
        let of_arrays: Vec<Vec<(u8, Vec<u8>)>> =
            arrays.iter().map(|array| texts(&array.attributes)).collect();
        let of_root = texts(attributes);
        if heap.count > 0 {
            self.put(&heap.collection())?;
        }
        let mut root = vec![
            // Link info: links are here and in no heap. Group info: nothing unusual.
            (0x02, [&[0, 0][..], &NOWHERE.to_le_bytes(), &NOWHERE.to_le_bytes()].concat()),
            (0x0a, vec![0, 0]),
        ];
        for (array, attributes) in arrays.iter().zip(of_arrays) {
            let mut messages = vec![
                (0x01, dataspace(&array.shape)),
                (0x03, array.element.message()),
                // The fill value: late allocation, written if it is set, which it is not.
                (0x05, vec![3, 0x0a]),
                (0x08, array.layout()),
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
        // All but the beginning is on the disk before the beginning says that there is a file.
        file.sync_all()?;
        file.seek(SeekFrom::Start(0))?;
        file.write_all(&superblock)?;
        file.sync_all()
    }

    /// Goes on where eight divides the place.
    fn pad(&mut self) -> io::Result<()> {
        let padding = usize::try_from(self.at.next_multiple_of(8) - self.at).unwrap_or(0);
        self.put(&[0; 8][..padding])
    }

    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.at += bytes.len() as u64;
        Ok(())
    }

    /// Bytes that the last array does not have yet.
    fn left(&self) -> u64 {
        self.arrays.last().map_or(0, |array| array.at + array.bytes - self.at)
    }

    fn check_whole(&self) -> Result<(), ArrayError> {
        match self.left() {
            0 => Ok(()),
            left => Err(self.not_all(left.into())),
        }
    }

    /// That the last array has so many bytes too few, or too many.
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
                format!("{whole}, as its shape and type say"),
            ),
        )
    }
}

impl Written {
    /// The message of where its elements lie: in one piece.
    fn layout(&self) -> Vec<u8> {
        let at = if self.bytes == 0 { NOWHERE } else { self.at };
        [&[3, 1][..], &at.to_le_bytes(), &self.bytes.to_le_bytes()].concat()
    }
}

fn owned(attributes: &[(&str, &str)]) -> Vec<(String, String)> {
    let each = attributes.iter();
    each.map(|(key, text)| ((*key).to_owned(), (*text).to_owned()))
        .collect()
}

/// The message of a shape, which never changes; that of no axis is one element.
fn dataspace(shape: &[u64]) -> Vec<u8> {
    let rank = u8::try_from(shape.len()).unwrap_or(u8::MAX);
    let mut message = vec![2, rank, 0, u8::from(rank > 0)];
    message.extend(shape.iter().flat_map(|side| side.to_le_bytes()));
    message
}

/// Texts of attributes, which lie in a collection of the global heap: so they come out of every library as texts, and not as bytes.
#[derive(Debug, Default)]
struct Heap {
    objects: Vec<u8>,
    count: u16,
}

/// Bytes of the header of a collection, and of that of an object in it.
const HEAP_HEADER: usize = 16;
/// The least size of a collection, bytes.
const HEAP_LEAST: usize = 4096;

impl Heap {
    /// Keeps a text; returns the number of its object, from 1.
    fn add(&mut self, text: &str) -> u16 {
        self.count += 1;
        self.objects.extend(self.count.to_le_bytes());
        // Referred to once.
        self.objects.extend([1, 0, 0, 0, 0, 0]);
        self.objects.extend((text.len() as u64).to_le_bytes());
        self.objects.extend(text.as_bytes());
        self.objects.resize(self.objects.len().next_multiple_of(8), 0);
        self.count
    }

    /// The collection, whose rest is an object without a number.
    fn collection(mut self) -> Vec<u8> {
        let used = HEAP_HEADER + self.objects.len();
        let size = (used + HEAP_HEADER).max(HEAP_LEAST);
        let mut collection = b"GCOL\x01\0\0\0".to_vec();
        collection.extend((size as u64).to_le_bytes());
        collection.append(&mut self.objects);
        collection.extend([0; 8]);
        collection.extend(((size - used) as u64).to_le_bytes());
        collection.resize(size, 0);
        collection
    }
}

/// The message of an attribute that is a text of `bytes` bytes, the object of that number in the heap at `heap`.
fn attribute(key: &str, bytes: usize, (heap, object): (u64, u16)) -> (u8, Vec<u8>) {
    // A text of any length in UTF-8: a length, and where it lies; of bytes.
    let mut kind = vec![0x19, 0x01, 0x01, 0, 16, 0, 0, 0];
    kind.extend(WrittenElement::U8.message());
    let space = dataspace(&[]);
    let size = |bytes: usize| u16::try_from(bytes).unwrap_or(u16::MAX).to_le_bytes();
    let mut message = vec![3, 0];
    message.extend(size(key.len() + 1));
    message.extend(size(kind.len()));
    message.extend(size(space.len()));
    // The name is UTF-8.
    message.push(1);
    message.extend(key.as_bytes());
    message.push(0);
    message.extend(kind);
    message.extend(space);
    message.extend(u32::try_from(bytes).unwrap_or(u32::MAX).to_le_bytes());
    message.extend(heap.to_le_bytes());
    message.extend(u32::from(object).to_le_bytes());
    (0x0c, message)
}

/// The message of a link to the object header at `at`, its name in UTF-8.
fn link(name: &str, at: u64) -> Vec<u8> {
    let length = u8::try_from(name.len()).unwrap_or(u8::MAX);
    let mut message = vec![1, 0x10, 1, length];
    message.extend(name.as_bytes());
    message.extend(at.to_le_bytes());
    message
}

/// An object header of these messages, each with its number.
fn header(messages: &[(u8, Vec<u8>)]) -> Vec<u8> {
    let mut body = Vec::new();
    for (number, message) in messages {
        body.push(*number);
        body.extend(u16::try_from(message.len()).unwrap_or(u16::MAX).to_le_bytes());
        body.push(0);
        body.extend(message);
    }
    // Version 2; its length has four bytes.
    let mut header = b"OHDR\x02\x02".to_vec();
    header.extend(u32::try_from(body.len()).unwrap_or(u32::MAX).to_le_bytes());
    header.extend(body);
    header.extend(lookup3(&header).to_le_bytes());
    header
}

/// The superblock of a file of `end` bytes whose root is at `root`.
fn superblock(end: u64, root: u64) -> Vec<u8> {
    // Version 2; addresses and lengths have eight bytes.
    let mut block = b"\x89HDF\r\n\x1a\n\x02\x08\x08\x00".to_vec();
    for address in [0, NOWHERE, end, root] {
        block.extend(address.to_le_bytes());
    }
    block.extend(lookup3(&block).to_le_bytes());
    block
}

fn failed(path: &Path, array: Option<&str>, problem: Problem) -> ArrayError {
    ArrayError {
        path: path.to_owned(),
        array: array.map(str::to_owned),
        problem,
    }
}
