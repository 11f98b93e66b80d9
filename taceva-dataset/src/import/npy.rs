//! Frames in a NumPy array file: `uint8` or `uint16`, `[n, height, width]` or `[n, height, width, 3]`, row by row.

use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use taceva_core::{Frame, FrameInfo, PixelFormat};

use crate::decode::ChannelOrder;
use crate::error::DatasetError;
use crate::file::open_regular;
use crate::limits;
use crate::text::shown;

/// An array of frames on disk, of which one frame at a time is read.
#[derive(Clone, Debug)]
pub(crate) struct NpyFrames {
    path: PathBuf,
    info: FrameInfo,
    count: usize,
    frame_bytes: usize,
    data_at: u64,
    is_big_endian: bool,
}

impl NpyFrames {
    /// Reads the header and compares it with the length of the file.
    pub(crate) fn open(path: &Path) -> Result<NpyFrames, DatasetError> {
        let (mut file, length) = open_regular(path, u64::MAX)?;
        let wrong = |problem: String| DatasetError::Image {
            place: None,
            path: path.to_owned(),
            problem,
        };
        let mut start = vec![0; usize::try_from(length).unwrap_or(usize::MAX).min(12)];
        file.read_exact(&mut start)
            .map_err(DatasetError::io("read", path))?;
        let (header_at, header_bytes) = header_range(&start).map_err(wrong)?;
        let mut header = vec![0; header_bytes];
        file.seek(SeekFrom::Start(header_at as u64))
            .and_then(|_| file.read_exact(&mut header))
            .map_err(|_| wrong("cut short: the header is longer than the file".to_owned()))?;
        let header =
            std::str::from_utf8(&header).map_err(|_| wrong("the header is no text".to_owned()))?;
        let layout = Layout::parse(header).map_err(wrong)?;
        let data_at = (header_at + header_bytes) as u64;
        let frame_bytes = layout
            .info
            .byte_len()
            .filter(|bytes| *bytes as u64 <= limits::DECODED_BYTES && *bytes > 0);
        let frame_bytes = frame_bytes
            .ok_or_else(|| wrong(format!("frames of {} are not accepted", layout.info)))?;
        let expected = (frame_bytes as u64)
            .checked_mul(layout.count as u64)
            .and_then(|data| data.checked_add(data_at));
        if expected != Some(length) {
            return Err(wrong(format!(
                "{length} bytes, which is not what {} frames of {} take",
                layout.count, layout.info
            )));
        }
        Ok(NpyFrames {
            path: path.to_owned(),
            info: layout.info,
            count: layout.count,
            frame_bytes,
            data_at,
            is_big_endian: layout.is_big_endian,
        })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether there is a frame at `index`.
    pub(crate) fn check_index(&self, index: usize) -> Result<(), DatasetError> {
        if index < self.count {
            return Ok(());
        }
        Err(DatasetError::Image {
            place: None,
            path: self.path.clone(),
            problem: format!("no frame {index}, there are {} from 0", self.count),
        })
    }

    /// The frame at `index`, its colours in the order in which they are stored.
    pub(crate) fn frame(&self, index: usize, order: ChannelOrder) -> Result<Frame, DatasetError> {
        let wrong = |problem: String| DatasetError::Image {
            place: None,
            path: self.path.clone(),
            problem,
        };
        self.check_index(index)?;
        let is_gray = self.info.format.samples() == 1;
        if is_gray != (order == ChannelOrder::Gray) {
            return Err(wrong(format!(
                "channel order `{}` is declared, the frames are {}",
                order.name(),
                self.info
            )));
        }
        let (mut file, _) = open_regular(&self.path, u64::MAX)?;
        let mut bytes = vec![0; self.frame_bytes];
        let at = self.data_at + index as u64 * self.frame_bytes as u64;
        file.seek(SeekFrom::Start(at))
            .and_then(|_| file.read_exact(&mut bytes))
            .map_err(DatasetError::io("read", &self.path))?;
        if self.is_big_endian {
            bytes
                .chunks_exact_mut(2)
                .for_each(|number| number.reverse());
        }
        Frame::new(self.info, bytes).map_err(|error| wrong(error.to_string()))
    }
}

/// Where the header text lies: versions 1 and 2 of the format.
fn header_range(start: &[u8]) -> Result<(usize, usize), String> {
    let (at, length) = match start {
        [0x93, b'N', b'U', b'M', b'P', b'Y', 1, _, a, b, ..] => {
            (10, usize::from(u16::from_le_bytes([*a, *b])))
        }
        [0x93, b'N', b'U', b'M', b'P', b'Y', 2, _, a, b, c, d] => {
            let length = u32::from_le_bytes([*a, *b, *c, *d]);
            (12, usize::try_from(length).unwrap_or(usize::MAX))
        }
        _ => return Err("no NumPy array file of version 1 or 2".to_owned()),
    };
    if length > limits::ARRAY_HEADER_BYTES {
        return Err(format!("a header of {length} bytes is not accepted"));
    }
    Ok((at, length))
}

/// What the header says.
struct Layout {
    info: FrameInfo,
    count: usize,
    is_big_endian: bool,
}

impl Layout {
    /// Understands `{'descr': '|u1', 'fortran_order': False, 'shape': (2, 4, 4), }`, whatever the order of its keys.
    fn parse(header: &str) -> Result<Layout, String> {
        let type_name = after_key(header, "descr")
            .and_then(|rest| rest.strip_prefix('\''))
            .and_then(|rest| rest.split('\'').next())
            .ok_or("the header names no plain type")?;
        let (bytes, is_big_endian) = match type_name {
            "|u1" | "<u1" | ">u1" | "=u1" => (1, false),
            "<u2" => (2, false),
            ">u2" => (2, true),
            other => {
                return Err(format!(
                    "numbers of type `{}`, expected `|u1` or `<u2`: scale to the full range of one of them and say so, \
                     so that nobody has to guess what 1.0 was",
                    shown(other)
                ));
            }
        };
        let order = after_key(header, "fortran_order").unwrap_or("");
        if !order.starts_with("False") {
            return Err("stored column by column; save it with order C".to_owned());
        }
        let shape = after_key(header, "shape")
            .and_then(|rest| rest.strip_prefix('('))
            .and_then(|rest| rest.split(')').next())
            .ok_or("the header names no shape")?;
        let sides = shape
            .split(',')
            .map(str::trim)
            .filter(|side| !side.is_empty())
            .map(|side| side.parse::<u32>().map_err(|_| side))
            .collect::<Result<Vec<u32>, &str>>()
            .map_err(|side| format!("`{}` is no size", shown(side)))?;
        let (count, height, width, colours) = match *sides.as_slice() {
            [count, height, width] => (count, height, width, 1),
            [count, height, width, 3] => (count, height, width, 3),
            _ => {
                return Err(format!(
                    "shape ({}), expected (n, height, width) or (n, height, width, 3)",
                    shown(shape)
                ));
            }
        };
        if width > limits::IMAGE_SIDE || height > limits::IMAGE_SIDE {
            return Err(format!("frames of {width}×{height} are not accepted"));
        }
        let format = match (bytes, colours) {
            (1, 1) => PixelFormat::Gray8,
            (1, _) => PixelFormat::Rgb8,
            (_, 1) => PixelFormat::Gray16,
            _ => PixelFormat::Rgb16,
        };
        Ok(Layout {
            info: FrameInfo {
                width,
                height,
                format,
            },
            count: count as usize,
            is_big_endian,
        })
    }
}

/// What follows `'key':` in a Python dictionary literal.
fn after_key<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = header.split_once(&format!("'{key}'"))?;
    Some(rest.trim_start().strip_prefix(':')?.trim_start())
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(crate) fn npy(header: &str, data: &[u8]) -> Vec<u8> {
        let mut file = b"\x93NUMPY\x01\x00".to_vec();
        let length = u16::try_from(header.len()).expect("short");
        file.extend_from_slice(&length.to_le_bytes());
        file.extend_from_slice(header.as_bytes());
        file.extend_from_slice(data);
        file
    }

    fn open(bytes: &[u8]) -> Result<NpyFrames, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x.npy");
        std::fs::write(&path, bytes).expect("written");
        NpyFrames::open(&path).map_err(|error| error.to_string())
    }

    #[test]
    fn one_frame_of_the_array_is_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x.npy");
        let header = "{'descr': '>u2', 'fortran_order': False, 'shape': (2, 1, 2), }\n";
        std::fs::write(&path, npy(header, &[0, 1, 0, 2, 1, 3, 0, 4])).expect("written");
        let frames = NpyFrames::open(&path).expect("opens");
        let frame = frames.frame(1, ChannelOrder::Gray).expect("reads");
        assert_eq!(frame.samples().collect::<Vec<_>>(), [0x0103, 4]);
        assert!(frames.frame(2, ChannelOrder::Gray).is_err());
        assert!(frames.frame(0, ChannelOrder::Rgb).is_err());
    }

    #[test]
    fn what_is_not_plain_frames_is_refused_in_words() {
        let header = |descr: &str, order: &str, shape: &str| {
            format!("{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}, }}")
        };
        for (descr, order, shape, expected) in [
            ("'<f4'", "False", "(1, 2, 2)", "expected `|u1` or `<u2`"),
            ("'|O'", "False", "(1,)", "expected `|u1`"),
            ("[('a', '<f4')]", "False", "(1,)", "no plain type"),
            ("'|u1'", "True", "(1, 2, 2)", "column by column"),
            ("'|u1'", "False", "(4,)", "expected (n, height, width)"),
            ("'|u1'", "False", "(1, -2, 2)", "no size"),
            ("'|u1'", "False", "(1, 99999, 2)", "not accepted"),
            ("'|u1'", "False", "(2, 2, 2)", "not what 2 frames"),
            ("'|u1'", "False", "(1, 0, 2)", "not accepted"),
        ] {
            let message = open(&npy(&header(descr, order, shape), &[0; 4])).expect_err(shape);
            assert!(message.contains(expected), "{message}");
        }
        assert!(open(b"PK\x03\x04").is_err());
        assert!(open(b"\x93NUMPY\x02\x00\xff\xff\xff\xff").is_err());
    }
}
