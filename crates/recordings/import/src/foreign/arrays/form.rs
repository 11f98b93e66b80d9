//! Interprets the rows of an array as pictures: axes, number types, or encoded bytes.

use std::ops::Range;

use taceva_arrays::{ArrayFile, ArrayInfo, ArrayValues, Element};
use taceva_core::{Frame, FrameInfo, PixelFormat};

use crate::foreign::columns::PictureKind;
use crate::foreign::pictures::Picture;
use crate::frame_names::{ArrayLayout, FrameNames, PixelRange};
use taceva_dataset::internal::{ImageKind, limits};

/// Maximum number of bytes read from an array at once.
pub(super) const READ_BYTES: u64 = 8 << 20;

/// Form of frames in the rows of an array.
#[derive(Debug)]
pub(super) enum Form {
    /// Bytes of an image file.
    Encoded,
    Pixels {
        info: FrameInfo,
        is_planar: bool,
        range: Option<PixelRange>,
    },
}

/// Minimum side, in pixels, of an array that a draft takes for pictures.
const LEAST_SIDE: u64 = 8;

/// Kind of pictures in an array; `None` if the array seems to contain no pictures.
pub(super) fn kind_of(file: &ArrayFile, name: &str, info: &ArrayInfo) -> Option<PictureKind> {
    if matches!(info.element, Element::Bytes | Element::Text) && info.shape.len() == 1 {
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

/// Form of the frames in an array, with the bytes per row (an estimate for encoded pictures).
pub(super) fn form_of(info: &ArrayInfo, names: &FrameNames) -> Result<(Form, u64), String> {
    let is_encoded = match names {
        FrameNames::Bytes(_) => true,
        FrameNames::Array(_) => matches!(info.element, Element::Bytes | Element::Text),
        _ => false,
    };
    if is_encoded && info.shape.len() == 1 {
        return match info.element {
            // Fixed-length fields other than text are read as bytes.
            Element::Bytes | Element::Text => Ok((Form::Encoded, READ_BYTES / 16)),
            other => Err(format!(
                "{other}, expected encoded pictures of any length for `bytes`"
            )),
        };
    }
    let FrameNames::Array(frames) = names else {
        return Err(
            "more than one axis, expected encoded pictures for `bytes`: read frames by `array`"
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
                "numbers of {other}, whose values of black and full are unknown: write `range = [BLACK, FULL]` and `bits = 8` or 16"
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
        return Err(format!(
            "frames of {info_of_frame}, expected sides of 1 to {} pixels and at most {} bytes per frame",
            limits::IMAGE_SIDE,
            limits::DECODED_BYTES
        ));
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
    Ok((form, row_bytes.ok_or("its rows exceed the address space")?))
}

/// Height, width and number of colours of the frames of an array, and true if the colours are planar.
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
                "{}, which looks like frame, colour, row, column: write `layout = \"nchw\"`",
                said()
            ));
        }
        _ => {
            return Err(format!(
                "{}, expected (n, height, width), (n, height, width, 3), or with `layout = \"nchw\"` (n, 3, height, width); a picture has \
                 1 or 3 colours",
                said()
            ));
        }
    };
    let side = |side: u64| u32::try_from(side).map_err(|_| format!("{}: side too long", said()));
    Ok((side(height)?, side(width)?, colours, is_planar))
}

impl Form {
    /// Decodes the picture of row `at` among the rows in `values`.
    pub(super) fn picture(&self, values: &ArrayValues, at: usize) -> Result<Picture, String> {
        let (info, is_planar, range) = match (self, values) {
            (Form::Encoded, ArrayValues::Bytes(all)) => {
                return Ok(Picture::Encoded(all[at].clone()));
            }
            (Form::Encoded, _) => {
                return Err("a string, expected the bytes of a picture".to_owned());
            }
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
        // Index in the row of a colour of a pixel.
        let place = |sample: usize| match is_planar {
            true => sample % colours * area + sample / colours,
            false => sample,
        };
        let bytes = match (values, range) {
            (ArrayValues::U8(all), None) => {
                let row = all.get(own).ok_or("fewer values than its shape states")?;
                match is_planar {
                    false => row.to_vec(),
                    true => (0..row.len()).map(|sample| row[place(sample)]).collect(),
                }
            }
            (ArrayValues::U16(all), None) => {
                let row = all.get(own).ok_or("fewer values than its shape states")?;
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

/// Values in the range `own` as `f64`.
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
        "expected numbers of up to 32 bits or floats, as many as the shape states".to_owned()
    })
}
