//! Pictures in messages. Encoded pictures such as JPEG keep their original bytes. Uncompressed samples are row by row, without padding.

use super::cdr::{Cdr, Want};
use super::schema::{Count, Kind, Message, RosSchema};
use crate::cell::Cell;
use crate::limits;

/// Picture in a message.
///
/// ```
/// use taceva_tables::{Picture, Recording, TableError};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/presses.mcap");
/// let table = Recording::open(path.as_ref())?.table("/tactile/image_raw")?;
/// table.visit_pictures::<TableError>("data", &[0], &mut |_, picture| {
///     let Picture::Samples(samples) = picture else { unreachable!() };
///     assert_eq!((samples.width, samples.height, samples.bytes.len()), (4, 3, 36));
///     Ok(())
/// })?;
/// # Ok::<(), TableError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Picture {
    /// Content of a picture file such as JPEG or PNG, unchanged.
    Encoded(Vec<u8>),
    /// Uncompressed samples.
    Samples(Samples),
}

/// Uncompressed picture.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Samples {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pixel format.
    pub form: SampleForm,
    /// Samples row by row from the top, without padding. Two-byte samples are little-endian.
    pub bytes: Vec<u8>,
}

/// Pixel format, named as in `sensor_msgs/Image`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SampleForm {
    /// Brightness as one byte per pixel.
    Mono8,
    /// Brightness as one number of two bytes per pixel.
    Mono16,
    /// One byte each of red, green and blue per pixel.
    Rgb8,
    /// One byte each of blue, green and red per pixel.
    Bgr8,
}

impl SampleForm {
    /// Size of a pixel, bytes.
    fn bytes(self) -> usize {
        match self {
            SampleForm::Mono8 => 1,
            SampleForm::Mono16 => 2,
            SampleForm::Rgb8 | SampleForm::Bgr8 => 3,
        }
    }
}

/// Picture field in the messages of a schema.
#[derive(Debug)]
pub(crate) struct PictureField {
    want: Want,
    is_raw: bool,
}

/// Slot of the bytes of a picture. The next constants are the slots of the other fields that describe the picture.
const DATA: usize = 0;
const FORMAT: usize = 1;
const HEIGHT: usize = 2;
const WIDTH: usize = 3;
const ENCODING: usize = 4;
const IS_BIG_ENDIAN: usize = 5;
const STEP: usize = 6;
const SLOTS: usize = 7;

impl PictureField {
    /// Finds the field `name`, which must be a list of `uint8`. Returns an error message for another type.
    pub(crate) fn new(schema: &RosSchema, name: &str) -> Result<PictureField, String> {
        let mut message = schema.root();
        let mut places = Vec::new();
        let (field, parents) = match name.rsplit_once('.') {
            Some((parents, field)) => (field, parents),
            None => (name, ""),
        };
        for parent in parents.split('.').filter(|parent| !parent.is_empty()) {
            let place = position(message, parent)
                .ok_or_else(|| format!("{} has no `{parent}`", message.name))?;
            let Kind::Message(inner) = message.fields[place].kind else {
                return Err(format!("`{parent}` of {} is not a message", message.name));
            };
            places.push((place, message.fields.len()));
            message = schema.message(inner);
        }
        let place =
            position(message, field).ok_or_else(|| format!("{} has no `{field}`", message.name))?;
        let is_bytes =
            message.fields[place].kind == Kind::U8 && message.fields[place].count != Count::One;
        if !is_bytes {
            return Err(format!(
                "`{field}` of {} is not a list of uint8",
                message.name
            ));
        }
        let is_raw = message.name == "sensor_msgs/Image";
        let mut wants = vec![Want::Nothing; message.fields.len()];
        wants[place] = Want::Bytes(DATA);
        let others: &[(&str, usize)] = match is_raw {
            true => &[
                ("height", HEIGHT),
                ("width", WIDTH),
                ("encoding", ENCODING),
                ("is_bigendian", IS_BIG_ENDIAN),
                ("step", STEP),
            ],
            false => &[("format", FORMAT)],
        };
        for (name, slot) in others {
            match position(message, name) {
                Some(place) => wants[place] = Want::Whole(*slot),
                None if is_raw => return Err(format!("{} has no `{name}`", message.name)),
                None => {}
            }
        }
        let mut want = Want::Fields(wants);
        for (place, fields) in places.into_iter().rev() {
            let mut wants = vec![Want::Nothing; fields];
            wants[place] = want;
            want = Want::Fields(wants);
        }
        Ok(PictureField { want, is_raw })
    }

    /// Reads the picture in `message`. Fails with an error message.
    pub(crate) fn read(&self, schema: &RosSchema, message: &[u8]) -> Result<Picture, String> {
        let mut slots = vec![Cell::Null; SLOTS];
        Cdr::new(message, schema.dialect())?.read(schema, &self.want, &mut slots)?;
        let data = match std::mem::replace(&mut slots[DATA], Cell::Null) {
            Cell::Bytes(bytes) => bytes,
            _ => return Err("the message has no bytes".to_owned()),
        };
        if self.is_raw {
            return raw(&slots, data)?.samples().map(Picture::Samples);
        }
        if slots[FORMAT].text().contains("compressedDepth") {
            return Err(
                "the format is compressedDepth, which is not supported; republish it as compressed"
                    .to_owned(),
            );
        }
        Ok(Picture::Encoded(data))
    }
}

fn position(message: &Message, name: &str) -> Option<usize> {
    message.fields.iter().position(|field| field.name == name)
}

fn raw(slots: &[Cell], data: Vec<u8>) -> Result<RawPicture, String> {
    let number = |slot: usize| match slots[slot] {
        Cell::Integer(value) => u32::try_from(value).map_err(|_| format!("a size of {value}")),
        _ => Err("a size is not a number".to_owned()),
    };
    Ok(RawPicture {
        width: number(WIDTH)?,
        height: number(HEIGHT)?,
        step: number(STEP)?,
        encoding: slots[ENCODING].text().into_owned(),
        is_big_endian: !matches!(slots[IS_BIG_ENDIAN], Cell::Integer(0) | Cell::Bool(false)),
        data,
    })
}

/// Uncompressed picture as its message describes it, before any check.
#[derive(Clone, Debug)]
pub(crate) struct RawPicture {
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// Distance between the starts of two rows, bytes.
    pub(crate) step: u32,
    pub(crate) encoding: String,
    pub(crate) is_big_endian: bool,
    pub(crate) data: Vec<u8>,
}

impl RawPicture {
    /// Checks the picture, removes padding, and makes samples little-endian. Returns an error message for an unsupported format.
    pub(crate) fn samples(self) -> Result<Samples, String> {
        let RawPicture {
            width,
            height,
            step,
            encoding,
            is_big_endian,
            data,
        } = self;
        let form = match &*encoding {
            "mono8" | "8UC1" => SampleForm::Mono8,
            "mono16" | "16UC1" => SampleForm::Mono16,
            "rgb8" => SampleForm::Rgb8,
            "bgr8" => SampleForm::Bgr8,
            other => {
                let other = crate::error::shown(other);
                return Err(format!(
                    "the encoding is `{other}`, expected mono8, mono16, rgb8 or bgr8"
                ));
            }
        };
        let (step, rows) = (step as usize, height as usize);
        let row = (width as usize).checked_mul(form.bytes());
        let row = row.filter(|row| *row > 0 && rows > 0 && *row <= step);
        let whole = step
            .checked_mul(rows)
            .filter(|whole| *whole as u64 <= limits::CELL_BYTES);
        let (Some(row), Some(whole)) = (row, whole) else {
            return Err(format!(
                "{width}×{height} pixels of {encoding}, {step} bytes per row, expected a pixel or more, rows that hold their pixels, and at most {} bytes",
                limits::CELL_BYTES
            ));
        };
        if data.len() != whole {
            return Err(format!(
                "{} bytes of samples, but {height} rows of {step} take {whole}",
                data.len()
            ));
        }
        let mut bytes = data;
        if row < step {
            let mut packed = Vec::with_capacity(row * rows);
            for line in bytes.chunks_exact(step) {
                packed.extend_from_slice(&line[..row]);
            }
            bytes = packed;
        }
        if is_big_endian && form == SampleForm::Mono16 {
            bytes
                .chunks_exact_mut(2)
                .for_each(|sample| sample.reverse());
        }
        Ok(Samples {
            width,
            height,
            form,
            bytes,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(
        encoding: &str,
        width: u32,
        step: u32,
        is_big_endian: u8,
        data: &[u8],
    ) -> Result<Samples, String> {
        let raw = RawPicture {
            width,
            height: 2,
            step,
            encoding: encoding.to_owned(),
            is_big_endian: is_big_endian != 0,
            data: data.to_vec(),
        };
        raw.samples()
    }

    #[test]
    fn padding_and_the_order_of_bytes_are_undone() {
        let read = |image: Result<Samples, String>| image.expect("a picture").bytes;
        assert_eq!(
            read(image("mono8", 2, 3, 0, &[1, 2, 9, 3, 4, 9])),
            [1, 2, 3, 4]
        );
        assert_eq!(read(image("mono16", 1, 2, 1, &[1, 2, 3, 4])), [2, 1, 4, 3]);
        assert_eq!(read(image("mono16", 1, 2, 0, &[1, 2, 3, 4])), [1, 2, 3, 4]);
        assert_eq!(
            read(image("bgr8", 1, 4, 1, &[1, 2, 3, 0, 4, 5, 6, 0])),
            [1, 2, 3, 4, 5, 6]
        );
    }

    #[test]
    fn other_pictures_are_refused_in_words() {
        for (image, expected) in [
            (
                image("bayer_rggb8", 2, 2, 0, &[0; 4]),
                "the encoding is `bayer_rggb8`, expected mono8",
            ),
            (
                image("rgb8", 2, 5, 0, &[0; 10]),
                "2×2 pixels of rgb8, 5 bytes per row",
            ),
            (image("mono8", 0, 0, 0, &[]), "0×2 pixels"),
            (
                image("mono8", 2, 2, 0, &[0; 3]),
                "3 bytes of samples, but 2 rows of 2 take 4",
            ),
            (image("mono8", u32::MAX, u32::MAX, 0, &[]), "bytes per row"),
        ] {
            let problem = image.expect_err(expected);
            assert!(problem.contains(expected), "{problem}");
        }
    }
}
