//! Depth maps: the bytes of one map, and the file with all maps of a task.
//!
//! A map consists of its encoding, its numbers of rows and columns, a bit mask of invalid pixels, and the depths. The depths are little-endian 32-bit
//! floating-point numbers, or a gray PNG.

use std::fs::{self, File, OpenOptions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use taceva_core::single;

use crate::decode::{ChannelOrder, ImageKind, decode};
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::refuse_link;
use crate::limits;
use crate::task::{MapEntry, MapFacts};

/// Size of the header before the mask, bytes: the encoding, then the numbers of rows and of columns.
const HEAD: usize = 9;

/// Depth map of a sample, read from a dataset.
///
/// ```
/// # use taceva_dataset::{MapFacts, StoredMap};
/// # use taceva_dataset::internal::map_of_numbers;
/// # let bytes = map_of_numbers([1, 2], &[250.0, f64::NAN], None)?;
/// let map = StoredMap::of(&bytes, &MapFacts::new("um"))?;
/// assert_eq!((map.rows, map.columns, map.mm[0]), (1, 2, 0.25));
/// assert!(map.mm[1].is_nan());
/// # Ok::<(), String>(())
/// ```
///
/// # Units
/// `mm` in mm.
#[non_exhaustive]
#[derive(Clone, Debug)]
pub struct StoredMap {
    /// Number of rows of pixels.
    pub rows: usize,
    /// Number of columns of pixels.
    pub columns: usize,
    /// Depths row by row; NaN for an invalid pixel.
    pub mm: Vec<f64>,
}

impl StoredMap {
    /// Map with the stored bytes `bytes`. `facts` states the unit and scale of the stored numbers.
    ///
    /// # Errors
    /// Error message if the bytes are not a map, or if `facts` states no unit of length or no finite scale.
    pub fn of(bytes: &[u8], facts: &MapFacts) -> Result<StoredMap, String> {
        let unit = facts.length()?;
        let parts = parts_of_map(bytes)?;
        let numbers: Vec<f64> = match parts.form {
            MapForm::Singles => singles(parts.data).map(f64::from).collect(),
            MapForm::Png => gray(parts.data, [parts.rows, parts.columns])?,
        };
        let depths = numbers.into_iter().enumerate().map(|(pixel, number)| {
            match is_set(parts.mask, pixel) {
                true => f64::NAN,
                false => unit.convert(number * facts.scale),
            }
        });
        Ok(StoredMap {
            rows: parts.rows,
            columns: parts.columns,
            mm: depths.collect(),
        })
    }

    /// Number of valid pixels.
    pub fn valid(&self) -> usize {
        self.mm.iter().filter(|depth| !depth.is_nan()).count()
    }
}

/// Encoding of the depths of a map.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapForm {
    /// 32-bit floating point, little endian.
    Singles,
    /// Gray PNG of 8 or 16 bits.
    Png,
}

/// Parts of the bytes of a map.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct MapParts<'a> {
    /// Encoding of the depths.
    pub form: MapForm,
    /// Number of rows of pixels.
    pub rows: usize,
    /// Number of columns of pixels.
    pub columns: usize,
    /// One bit for each pixel, the lowest first; set for an invalid pixel.
    pub mask: &'a [u8],
    /// Encoded depths.
    pub data: &'a [u8],
}

impl MapParts<'_> {
    /// True if `pixel`, counted row by row, is invalid.
    pub fn is_invalid(&self, pixel: usize) -> bool {
        is_set(self.mask, pixel)
    }
}

/// Parts of the map stored as `bytes`.
#[doc(hidden)]
pub fn parts_of_map(bytes: &[u8]) -> Result<MapParts<'_>, String> {
    let cut = || "the depth map is cut short".to_owned();
    let side = |at: usize| {
        let side = bytes.get(at..at + 4).and_then(|side| side.try_into().ok());
        let side = u32::from_le_bytes(side.ok_or_else(cut)?);
        match (1..=limits::IMAGE_SIDE).contains(&side) {
            true => Ok(side as usize),
            false => Err(format!(
                "a depth map with a side of {side} pixels, expected 1 to {}",
                limits::IMAGE_SIDE
            )),
        }
    };
    let form = match bytes.first() {
        Some(0) => MapForm::Singles,
        Some(1) => MapForm::Png,
        Some(form) => return Err(format!("a depth map of the unknown form {form}")),
        None => return Err(cut()),
    };
    let (rows, columns) = (side(1)?, side(5)?);
    check_pixels([rows, columns])?;
    let mask_bytes = (rows * columns).div_ceil(8);
    let (mask, data) = bytes
        .get(HEAD..)
        .and_then(|rest| rest.split_at_checked(mask_bytes))
        .ok_or_else(cut)?;
    if form == MapForm::Singles && data.len() != rows * columns * 4 {
        return Err(cut());
    }
    Ok(MapParts {
        form,
        rows,
        columns,
        mask,
        data,
    })
}

/// Bytes of a map with `rows` × `columns` numbers, row by row. NaN and `invalid` mark invalid pixels.
#[doc(hidden)]
pub fn map_of_numbers(
    [rows, columns]: [usize; 2],
    numbers: &[f64],
    invalid: Option<f64>,
) -> Result<Vec<u8>, String> {
    if rows.checked_mul(columns) != Some(numbers.len()) {
        return Err(format!(
            "{} numbers, expected {rows} x {columns}",
            numbers.len()
        ));
    }
    let is_invalid = |number: f64| number.is_nan() || is_marker(number, invalid);
    let mut bytes = head(MapForm::Singles, [rows, columns])?;
    bytes.extend(mask(numbers.iter().map(|number| is_invalid(*number))));
    for (pixel, number) in numbers.iter().enumerate() {
        // Equal maps have equal bytes, whatever marks their invalid pixels.
        let kept = if is_invalid(*number) {
            0.0
        } else {
            single(*number)
        };
        if !kept.is_finite() {
            return Err(format!(
                "column {}, row {} is {number}, expected a depth, or NaN for an invalid pixel",
                pixel % columns,
                pixel / columns
            ));
        }
        bytes.extend(kept.to_le_bytes());
    }
    Ok(bytes)
}

/// Bytes of a map with the gray PNG `png`, in which the number `invalid` marks invalid pixels.
#[doc(hidden)]
pub fn map_of_png(png: &[u8], invalid: Option<f64>) -> Result<Vec<u8>, String> {
    let (kind, frame) = decode(png, ChannelOrder::Gray)?;
    let info = frame.info();
    if kind != ImageKind::Png || info.format.samples() != 1 {
        return Err(format!(
            "a depth map is a gray PNG of 8 or 16 bits, found {} {info}",
            kind.extension()
        ));
    }
    let size = [info.height as usize, info.width as usize];
    let mut bytes = head(MapForm::Png, size)?;
    let numbers = frame.samples().map(f64::from);
    bytes.extend(mask(numbers.map(|number| is_marker(number, invalid))));
    bytes.extend(png);
    Ok(bytes)
}

/// True if `number` equals the marker `invalid`, bit by bit except for the sign of zero.
fn is_marker(number: f64, invalid: Option<f64>) -> bool {
    invalid.is_some_and(|invalid| (invalid + 0.0).to_bits() == (number + 0.0).to_bits())
}

fn head(form: MapForm, size: [usize; 2]) -> Result<Vec<u8>, String> {
    let mut bytes = vec![match form {
        MapForm::Singles => 0,
        MapForm::Png => 1,
    }];
    for side in size {
        let side = u32::try_from(side).unwrap_or(u32::MAX);
        if !(1..=limits::IMAGE_SIDE).contains(&side) {
            return Err(format!(
                "a side of {side} pixels, expected 1 to {}",
                limits::IMAGE_SIDE
            ));
        }
        bytes.extend(side.to_le_bytes());
    }
    check_pixels(size)?;
    Ok(bytes)
}

fn check_pixels([rows, columns]: [usize; 2]) -> Result<(), String> {
    match rows.saturating_mul(columns) <= limits::MAP_PIXELS {
        true => Ok(()),
        false => Err(format!(
            "a depth map of {rows} x {columns} pixels, expected up to {} pixels",
            limits::MAP_PIXELS
        )),
    }
}

/// One bit for each pixel, the lowest first; set for an invalid pixel.
fn mask(invalid: impl Iterator<Item = bool>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (pixel, is_invalid) in invalid.enumerate() {
        if pixel % 8 == 0 {
            bytes.push(0);
        }
        if let (true, Some(last)) = (is_invalid, bytes.last_mut()) {
            *last |= 1 << (pixel % 8);
        }
    }
    bytes
}

fn is_set(mask: &[u8], pixel: usize) -> bool {
    let byte = mask.get(pixel / 8).copied().unwrap_or_default();
    byte & (1 << (pixel % 8)) != 0
}

fn singles(data: &[u8]) -> impl Iterator<Item = f32> + '_ {
    let numbers = data.chunks_exact(4);
    numbers.map(|number| f32::from_le_bytes([number[0], number[1], number[2], number[3]]))
}

/// Pixel values of a gray PNG with the numbers of rows and columns in `size`.
fn gray(png: &[u8], size: [usize; 2]) -> Result<Vec<f64>, String> {
    let (_, frame) = decode(png, ChannelOrder::Gray)?;
    let info = frame.info();
    let found = [info.height as usize, info.width as usize];
    match found == size && info.format.samples() == 1 {
        true => Ok(frame.samples().map(f64::from).collect()),
        false => Err(format!(
            "a picture of {info}, expected {} x {} gray pixels",
            size[1], size[0]
        )),
    }
}

/// File with the maps of a task, to which maps are appended.
#[doc(hidden)]
#[derive(Debug)]
pub struct MapPack {
    path: PathBuf,
    file: BufWriter<File>,
    length: u64,
}

impl MapPack {
    /// Creates the pack at `path`, beginning with the maps of the pack at `before`, if any.
    pub fn create(path: &Path, before: Option<&Path>) -> Result<MapPack, DatasetError> {
        refuse_link(path)?;
        let length = match before {
            // The former file may be open elsewhere, so it is copied.
            Some(before) => fs::copy(before, path).map_err(DatasetError::io("copy", before))?,
            None => 0,
        };
        let file = OpenOptions::new()
            .append(true)
            .create(true)
            .open(path)
            .map_err(DatasetError::io("open", path))?;
        Ok(MapPack {
            path: path.to_owned(),
            file: BufWriter::new(file),
            length,
        })
    }

    /// Appends the map with the bytes `bytes`.
    pub fn append(&mut self, bytes: &[u8]) -> Result<MapEntry, DatasetError> {
        let length = u32::try_from(bytes.len()).ok();
        let length = length.filter(|length| u64::from(*length) <= limits::IMAGE_BYTES);
        let length = length.ok_or_else(|| {
            DatasetError::request(&self.path, format!("a depth map of {} bytes", bytes.len()))
        })?;
        let entry = MapEntry::new(self.length, length, Digest::of(bytes));
        self.file
            .write_all(bytes)
            .map_err(DatasetError::io("append to", &self.path))?;
        self.length += u64::from(length);
        Ok(entry)
    }

    /// Syncs the maps to disk, but not the name of the file.
    pub fn finish(mut self) -> Result<(), DatasetError> {
        let flushed = self.file.flush();
        let synced = flushed.and_then(|()| self.file.get_ref().sync_all());
        synced.map_err(DatasetError::io("make durable", &self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{Frame, FrameInfo, PixelFormat};

    #[test]
    fn numbers_and_pictures_read_back_in_millimetres_with_their_invalid_pixels() {
        let mut facts = MapFacts::new("um");
        let numbers = map_of_numbers([2, 2], &[0.0, 1500.0, -1.0, f64::NAN], Some(-1.0));
        let map = StoredMap::of(&numbers.expect("finite"), &facts).expect("a map");
        assert_eq!((map.rows, map.columns, map.valid()), (2, 2, 2));
        assert_eq!(map.mm[1].to_bits(), 1.5_f64.to_bits());
        assert!(map.mm[2].is_nan() && map.mm[3].is_nan());
        let info = FrameInfo {
            width: 3,
            height: 1,
            format: PixelFormat::Gray16,
        };
        let pixels = [0_u16, 40_000, 65_535].map(u16::to_le_bytes).concat();
        let frame = Frame::new(info, pixels).expect("three pixels");
        let png = crate::encode::encode_png(&frame).expect("a PNG");
        facts.scale = 0.1;
        let map = StoredMap::of(&map_of_png(&png, Some(0.0)).expect("gray"), &facts);
        let map = map.expect("a map");
        assert_eq!((map.rows, map.columns, map.valid()), (1, 3, 2));
        assert_eq!(map.mm[1].to_bits(), 4.0_f64.to_bits());
    }

    #[test]
    fn the_marker_of_invalid_pixels_does_not_change_the_bytes_of_a_map() {
        let with_nan = map_of_numbers([1, 2], &[1.0, f64::NAN], None);
        assert_eq!(with_nan, map_of_numbers([1, 2], &[1.0, 9.0], Some(9.0)));
    }

    #[test]
    fn infinite_depths_and_other_counts_of_numbers_are_refused() {
        let infinite = map_of_numbers([1, 2], &[1.0, f64::INFINITY], None);
        assert_eq!(
            infinite.expect_err("infinite"),
            "column 1, row 0 is inf, expected a depth, or NaN for an invalid pixel"
        );
        assert!(map_of_numbers([2, 2], &[1.0], None).is_err());
        assert!(map_of_numbers([0, 2], &[], None).is_err());
    }

    #[test]
    fn bytes_that_are_cut_short_are_no_map() {
        let whole = map_of_numbers([1, 2], &[1.0, 2.0], None).expect("finite");
        for length in 0..whole.len() {
            assert!(parts_of_map(&whole[..length]).is_err(), "{length}");
        }
        assert!(parts_of_map(&whole).is_ok());
    }

    #[test]
    fn a_map_of_more_pixels_than_are_held_is_refused_by_its_size_alone() {
        let mut bytes = vec![1];
        bytes.extend([16_384_u32, 16_384].map(u32::to_le_bytes).concat());
        let refused = parts_of_map(&bytes).map(|parts| parts.rows);
        assert_eq!(
            refused.expect_err("too large"),
            "a depth map of 16384 x 16384 pixels, expected up to 33554432 pixels"
        );
    }
}
