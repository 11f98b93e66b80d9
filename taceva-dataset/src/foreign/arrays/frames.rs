//! Frames in arrays.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use taceva_arrays::{ArrayFile, ArrayFormat, ArrayInfo, ArrayValues, Element};
use taceva_core::{Frame, FrameInfo, PixelFormat};

use super::problem;
use crate::decode::{ChannelOrder, ImageKind};
use crate::error::DatasetError;
use crate::foreign::columns::PictureKind;
use crate::foreign::pictures::{Picture, Pictures, Visit, damaged};
use crate::guard::guarded;
use crate::import::{ArrayFrames, ArrayLayout, FrameNames, PixelRange};
use crate::limits;

/// What is read of an array at once, bytes.
const READ_BYTES: u64 = 8 << 20;

/// The frames of one array, or of several one after the other.
#[derive(Debug)]
pub(crate) struct ArrayPictures {
    path: PathBuf,
    file: Arc<ArrayFile>,
    arrays: Vec<FrameArray>,
}

#[derive(Debug)]
struct FrameArray {
    name: String,
    /// The number of its first frame among those of all.
    first: u64,
    rows: u64,
    row_bytes: u64,
    form: Form,
}

/// How the rows of an array are frames.
#[derive(Debug)]
enum Form {
    /// Bytes of a file of a picture.
    Encoded,
    Pixels {
        info: FrameInfo,
        is_planar: bool,
        range: Option<PixelRange>,
    },
}

impl ArrayPictures {
    /// The frames in the file at `path`, of the array that `frames` names or of the only one.
    pub(crate) fn open(
        path: &Path,
        names: &FrameNames,
        frames: &ArrayFrames,
    ) -> Result<ArrayPictures, DatasetError> {
        let opened = guarded(|| {
            let format = ArrayFormat::of(path).unwrap_or(ArrayFormat::Npy);
            let file = ArrayFile::open(path, format).map_err(problem)?;
            let names_there = file.names();
            let array = match (&frames.path, names_there.as_slice()) {
                (Some(array), _) => array.clone(),
                (None, [only]) => only.clone(),
                (None, _) => {
                    return Err(format!(
                        "it holds several arrays, of which `path` names one: {}",
                        names_there.join(", ")
                    ));
                }
            };
            ArrayPictures::new((path, Arc::new(file)), vec![array], names)
        });
        opened
            .and_then(|opened| opened)
            .map_err(|problem| damaged(path, problem))
    }

    pub(super) fn new(
        (path, file): (&Path, Arc<ArrayFile>),
        arrays: Vec<String>,
        names: &FrameNames,
    ) -> Result<ArrayPictures, String> {
        let mut first = 0_u64;
        let mut found = Vec::with_capacity(arrays.len());
        for name in arrays {
            let info = file.info(&name).ok_or_else(|| {
                format!(
                    "there is no array `{name}`; there are {}",
                    file.names().join(", ")
                )
            })?;
            let (form, row_bytes) =
                form_of(info, names).map_err(|problem| format!("`{name}`: {problem}"))?;
            let rows = info.rows();
            found.push(FrameArray {
                name,
                first,
                rows,
                row_bytes,
                form,
            });
            first = first
                .checked_add(rows)
                .ok_or("more frames than can be counted")?;
        }
        Ok(ArrayPictures {
            path: path.to_owned(),
            file,
            arrays: found,
        })
    }

    /// Reads those of the rows of one array that follow one another, a few megabytes at a time.
    fn visit_run(
        &self,
        array: &FrameArray,
        run: Range<u64>,
        each: Visit<'_>,
    ) -> Result<(), DatasetError> {
        let at_once = (READ_BYTES / array.row_bytes.max(1)).max(1);
        let mut next = run.start;
        while next < run.end {
            let end = run.end.min(next + at_once);
            let read = guarded(|| self.file.read(&array.name, next..end).map_err(problem));
            let read = read
                .and_then(|read| read)
                .map_err(|problem| damaged(self.path(), problem))?;
            for row in next..end {
                let at = as_size(row - next);
                let number = array.first + row;
                let picture = array.form.picture(&read.values, at).map_err(|problem| {
                    damaged(self.path(), format!("frame {number}: {problem}"))
                })?;
                each(number, picture)?;
            }
            next = end;
        }
        Ok(())
    }
}

impl Pictures for ArrayPictures {
    fn path(&self) -> &Path {
        &self.path
    }

    fn count(&self) -> u64 {
        let last = self.arrays.last();
        last.map_or(0, |array| array.first + array.rows)
    }

    fn visit(
        &self,
        sorted: &[u64],
        _order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), DatasetError> {
        for array in &self.arrays {
            let begin = sorted.partition_point(|index| *index < array.first);
            let end = sorted.partition_point(|index| *index < array.first + array.rows);
            let own = &sorted[begin..end];
            for run in own.chunk_by(|before, after| before + 1 == *after) {
                let first = run[0] - array.first;
                self.visit_run(array, first..first + run.len() as u64, each)?;
            }
        }
        Ok(())
    }
}

/// The least side of an array that is taken for pictures without being named so, pixels.
const LEAST_SIDE: u64 = 8;

/// How an array holds pictures, if it seems to.
pub(super) fn kind_of(file: &ArrayFile, name: &str, info: &ArrayInfo) -> Option<PictureKind> {
    if info.element == Element::Bytes && info.shape.len() == 1 {
        let first = file.read(name, 0..1).ok()?;
        let ArrayValues::Bytes(all) = first.values else {
            return None;
        };
        return ImageKind::of(all.first()?).map(|_| PictureKind::Encoded);
    }
    let is_planar = matches!(info.shape.as_slice(), [_, 1 | 3, height, width] if *height >= LEAST_SIDE && *width > 4);
    let layout = is_planar.then_some(ArrayLayout::Nchw);
    let (height, width, colours, _) = sides(&info.shape, layout).ok()?;
    if u64::from(height.min(width)) < LEAST_SIDE || info.element == Element::Text {
        return None;
    }
    let range = match info.element {
        Element::Unsigned(8 | 16) => None,
        _ => {
            let row_bytes = info.row_elements()?.checked_mul(8)?;
            let rows = (READ_BYTES / row_bytes.max(1)).clamp(1, info.rows().max(1));
            let numbers = file.read(name, 0..rows).ok()?;
            let numbers = numbers.values.to_f64()?;
            let least = numbers.iter().copied().reduce(f64::min)?;
            Some([least, numbers.iter().copied().reduce(f64::max)?])
        }
    };
    Some(PictureKind::Array {
        is_gray: colours == 1,
        is_planar,
        range,
    })
}

/// How the rows of an array are frames, and the bytes of each in the file.
fn form_of(info: &ArrayInfo, names: &FrameNames) -> Result<(Form, u64), String> {
    if let (FrameNames::Bytes(_), 1) = (names, info.shape.len()) {
        return match info.element {
            Element::Bytes => Ok((Form::Encoded, READ_BYTES / 16)),
            other => Err(format!(
                "{other}, where `bytes` are encoded pictures of any length"
            )),
        };
    }
    let FrameNames::Array(frames) = names else {
        return Err(
            "more than one axis, where `bytes` are encoded pictures: `array` reads frames"
                .to_owned(),
        );
    };
    let (height, width, colours, is_planar) = sides(&info.shape, frames.layout)?;
    let (bits, range) = match (info.element, frames.range) {
        (Element::Unsigned(8), None) => (8, None),
        (Element::Unsigned(16), None) => (16, None),
        (Element::Text | Element::Bytes, _) => {
            return Err(format!("{}, expected numbers", info.element));
        }
        (_, Some(range)) => (range.bits(), Some(range)),
        (other, None) => {
            return Err(format!(
                "numbers of {other}, of which nobody knows which is black and which is full: write `range = [BLACK, FULL]` and `bits = 8` or 16"
            ));
        }
    };
    let format = match (bits, colours) {
        (8, 1) => PixelFormat::Gray8,
        (8, _) => PixelFormat::Rgb8,
        (_, 1) => PixelFormat::Gray16,
        _ => PixelFormat::Rgb16,
    };
    let info_of_frame = FrameInfo {
        width,
        height,
        format,
    };
    let is_accepted =
        width > 0 && height > 0 && width <= limits::IMAGE_SIDE && height <= limits::IMAGE_SIDE;
    let bytes = info_of_frame.byte_len().map(|bytes| bytes as u64);
    if !is_accepted || bytes.is_none_or(|bytes| bytes > limits::DECODED_BYTES) {
        return Err(format!("frames of {info_of_frame} are not accepted"));
    }
    let wide = match info.element {
        Element::Unsigned(bits) | Element::Signed(bits) | Element::Float(bits) => {
            u64::from(bits / 8)
        }
        _ => 1,
    };
    let row_bytes = info
        .row_elements()
        .and_then(|count| count.checked_mul(wide));
    let form = Form::Pixels {
        info: info_of_frame,
        is_planar,
        range,
    };
    Ok((form, row_bytes.ok_or("larger than any memory")?))
}

/// Height, width and colours of the frames of an array, and whether each colour is a plane of its own.
fn sides(shape: &[u64], layout: Option<ArrayLayout>) -> Result<(u32, u32, u64, bool), String> {
    let said = || {
        let sides: Vec<String> = shape.iter().map(u64::to_string).collect();
        format!("shape ({})", sides.join(", "))
    };
    let (height, width, colours, is_planar) = match (shape, layout) {
        (&[_, height, width], None | Some(ArrayLayout::Nhw)) => (height, width, 1, false),
        (&[_, height, width, colours @ (1 | 3)], None | Some(ArrayLayout::Nhwc)) => {
            (height, width, colours, false)
        }
        (&[_, colours @ (1 | 3), height, width], Some(ArrayLayout::Nchw)) => {
            (height, width, colours, true)
        }
        (&[_, 1 | 3, _, _], None) => {
            return Err(format!(
                "{}, which looks like frame, colour, row, column: `layout = \"nchw\"` says so",
                said()
            ));
        }
        _ => {
            return Err(format!(
                "{}, expected (n, height, width), (n, height, width, 3), or with `layout = \"nchw\"` (n, 3, height, width); a colour more or less is no \
                 picture here",
                said()
            ));
        }
    };
    let side = |side: u64| u32::try_from(side).map_err(|_| format!("{} is not accepted", said()));
    Ok((side(height)?, side(width)?, colours, is_planar))
}

impl Form {
    /// The picture at `at` among the rows that `values` are of.
    fn picture(&self, values: &ArrayValues, at: usize) -> Result<Picture, String> {
        let (info, is_planar, range) = match (self, values) {
            (Form::Encoded, ArrayValues::Bytes(all)) => {
                return Ok(Picture::Encoded(all[at].clone()));
            }
            (Form::Encoded, _) => return Err("no bytes".to_owned()),
            (
                Form::Pixels {
                    info,
                    is_planar,
                    range,
                },
                _,
            ) => (*info, *is_planar, range),
        };
        let colours = info.format.samples();
        let area = info.width as usize * info.height as usize;
        let own = at * area * colours..(at + 1) * area * colours;
        // The place in the row of a colour of a pixel.
        let place = |sample: usize| match is_planar {
            true => sample % colours * area + sample / colours,
            false => sample,
        };
        let bytes = match (values, range) {
            (ArrayValues::U8(all), None) => {
                let row = all.get(own).ok_or("fewer values than the shape says")?;
                match is_planar {
                    false => row.to_vec(),
                    true => (0..row.len()).map(|sample| row[place(sample)]).collect(),
                }
            }
            (ArrayValues::U16(all), None) => {
                let row = all.get(own).ok_or("fewer values than the shape says")?;
                (0..row.len())
                    .flat_map(|sample| row[place(sample)].to_le_bytes())
                    .collect()
            }
            (_, Some(range)) => {
                let numbers = numbers(values, own)?;
                let mut bytes = Vec::with_capacity(numbers.len() * usize::from(range.bits() / 8));
                for sample in 0..numbers.len() {
                    let number = numbers[place(sample)];
                    let [black, full] = range.ends();
                    let pixel = range.pixel(number).ok_or_else(|| {
                        format!("{number} is outside of `range = [{black}, {full}]`")
                    })?;
                    match range.bits() {
                        8 => bytes.extend(u8::try_from(pixel)),
                        _ => bytes.extend(pixel.to_le_bytes()),
                    }
                }
                bytes
            }
            _ => return Err("numbers of another type than the array declares".to_owned()),
        };
        let frame = Frame::new(info, bytes).map_err(|error| error.to_string())?;
        Ok(Picture::Pixels(frame))
    }
}

/// Those of the values as 64 bit numbers.
fn numbers(values: &ArrayValues, own: Range<usize>) -> Result<Vec<f64>, String> {
    fn of<T: Copy + Into<f64>>(all: &[T], own: Range<usize>) -> Option<Vec<f64>> {
        Some(all.get(own)?.iter().map(|value| (*value).into()).collect())
    }
    let numbers = match values {
        ArrayValues::U8(all) => of(all, own),
        ArrayValues::U16(all) => of(all, own),
        ArrayValues::U32(all) => of(all, own),
        ArrayValues::I8(all) => of(all, own),
        ArrayValues::I16(all) => of(all, own),
        ArrayValues::I32(all) => of(all, own),
        ArrayValues::F32(all) => of(all, own),
        ArrayValues::F64(all) => of(all, own),
        ArrayValues::Bool(all) => all.get(own).map(|own| {
            own.iter()
                .map(|value| f64::from(u8::from(*value)))
                .collect()
        }),
        _ => None,
    };
    numbers.ok_or_else(|| {
        "whole numbers of 64 bits are no pixels, or there are fewer than the shape says".to_owned()
    })
}

/// A length within one reading, which is of few megabytes.
fn as_size(length: u64) -> usize {
    usize::try_from(length).unwrap_or(usize::MAX)
}
