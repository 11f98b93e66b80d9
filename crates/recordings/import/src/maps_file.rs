//! Depth maps in an array of another file: one map for each row, read in blocks.

use std::ops::Range;
use std::path::Path;

use crate::error::{ImportError, table_error};
use crate::foreign::OneArray;
use taceva_dataset::internal::{limits, shown};

/// Maximum number of values in one read: 8 MiB as `f64`.
const READ_NUMBERS: u64 = 1 << 20;

/// Array of depth maps in a file of another program, such as a `.npy`. Its axes are the map, the pixel row and the pixel column.
///
/// ```
/// use taceva_import::MapsFile;
///
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("maps.npy");
/// # let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 2), }";
/// # let mut bytes = [&b"\x93NUMPY\x01\x00\x76\x00"[..], format!("{header:<117}\n").as_bytes()].concat();
/// # bytes.extend([0.25_f32, 0.5].map(f32::to_le_bytes).concat());
/// # std::fs::write(&path, bytes)?;
/// let maps = MapsFile::open(&path, None)?;
/// assert_eq!((maps.count(), maps.size()), (1, [1, 2]));
/// assert_eq!(maps.map(0)?, [0.25, 0.5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct MapsFile {
    array: OneArray,
    rows: u64,
    size: [usize; 2],
}

impl MapsFile {
    /// Opens the array `name` of the file at `path`, or its only array.
    ///
    /// # Errors
    /// [`ImportError`] if the file cannot be read or the array has no maps.
    pub fn open(path: &Path, name: Option<&str>) -> Result<MapsFile, ImportError> {
        let array = OneArray::open(path, name)?;
        let side = |side: &u64| usize::try_from(*side).ok().filter(|side| *side > 0);
        let found = match array.shape() {
            [rows, height, width] => side(height).zip(side(width)).map(|size| (*rows, size)),
            // The file of one sample.
            [height, width] => side(height).zip(side(width)).map(|size| (1, size)),
            _ => None,
        };
        let found = found.filter(|(rows, _)| *rows > 0);
        let Some((rows, (height, width))) = found else {
            return Err(table_error!(
                path,
                "`{}` of shape {:?} has no depth maps, expected samples × rows × columns of pixels",
                shown(array.name()),
                array.shape()
            ));
        };
        let (greatest, most) = (limits::IMAGE_SIDE as usize, limits::MAP_PIXELS);
        let is_small = height.max(width) <= greatest && height * width <= most;
        if !is_small {
            return Err(table_error!(
                path,
                "depth maps of {height} x {width} pixels, expected sides up to {greatest} pixels and up to {most} pixels in all"
            ));
        }
        Ok(MapsFile {
            array,
            rows,
            size: [height, width],
        })
    }

    /// Number of maps.
    pub fn count(&self) -> u64 {
        self.rows
    }

    /// Number of pixel rows and of pixel columns of each map.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Pixel values of the depth map at `position`, from 0, row by row.
    ///
    /// # Errors
    /// [`ImportError`] if the file cannot be read, has no numbers, or has no such map.
    pub fn map(&self, position: u64) -> Result<Vec<f64>, ImportError> {
        let mut maps = self.maps(position..position.saturating_add(1))?;
        let map = maps.pop();
        map.ok_or_else(|| table_error!(self.array.path(), "no depth map {position}"))
    }

    /// Depth maps at the positions `range`, each with its values row by row.
    pub(crate) fn maps(&self, range: Range<u64>) -> Result<Vec<Vec<f64>>, ImportError> {
        let [rows, columns] = self.size;
        if range.end > self.rows {
            return Err(table_error!(
                self.array.path(),
                "{} depth maps, fewer than the table has rows",
                self.rows
            ));
        }
        let numbers = match self.array.shape().len() {
            2 => self.array.read(0..rows as u64)?,
            _ => self.array.read(range)?,
        };
        let maps = numbers.chunks_exact(rows * columns);
        Ok(maps.map(<[f64]>::to_vec).collect())
    }

    pub(crate) fn path(&self) -> &Path {
        self.array.path()
    }

    /// Number of maps in one read.
    pub(crate) fn step(&self) -> u64 {
        let [rows, columns] = self.size;
        (READ_NUMBERS / (rows as u64 * columns as u64).max(1)).max(1)
    }
}
