//! Codec name of a Matroska or WebM file, for the error if no decoder is available.

use crate::error::VideoError;
use crate::source::Source;

const SEGMENT: u32 = 0x1853_8067;
const TRACKS: u32 = 0x1654_ae6b;
const TRACK: u32 = 0xae;
const TRACK_TYPE: u32 = 0x83;
const CODEC: u32 = 0x86;
/// Maximum number of elements in the search for the name.
const MOST_ELEMENTS: u32 = 10_000;

/// True if a file that begins with `start` is a Matroska or WebM file.
pub(crate) fn is_matroska(start: &[u8]) -> bool {
    start.starts_with(&[0x1a, 0x45, 0xdf, 0xa3])
}

/// Codec of the first video track; `None` if it is not found.
pub(crate) fn codec(source: &Source) -> Result<Option<String>, VideoError> {
    let mut left = MOST_ELEMENTS;
    let mut tracks = None;
    let mut outer = Elements::new(source, 0, source.length(), &mut left);
    while let Some(element) = outer.next()? {
        match element.id {
            // Visits its children next.
            SEGMENT => outer.enter(&element),
            TRACKS => {
                tracks = Some(element);
                break;
            }
            _ => {}
        }
    }
    let Some(tracks) = tracks else {
        return Ok(None);
    };
    let mut entries = Elements::new(source, tracks.body, tracks.end, &mut left);
    let (mut is_video, mut name) = (false, None);
    while let Some(element) = entries.next()? {
        match element.id {
            TRACK => {
                (is_video, name) = (false, None);
                entries.enter(&element);
            }
            TRACK_TYPE => is_video = element.bytes(source)?.last() == Some(&1),
            CODEC => name = Some(String::from_utf8_lossy(&element.bytes(source)?).into_owned()),
            _ => {}
        }
        if let (true, Some(name)) = (is_video, &name) {
            return Ok(Some(known(name)));
        }
    }
    Ok(None)
}

/// Common name of a Matroska codec name: `FFV1` for `V_FFV1`.
fn known(name: &str) -> String {
    let known = match name {
        "V_MPEG4/ISO/AVC" => "H.264",
        "V_MPEGH/ISO/HEVC" => "HEVC",
        "V_MPEG4/ISO/ASP" => "MPEG-4 part 2",
        "V_MPEG2" => "MPEG-2",
        other => other.strip_prefix("V_").unwrap_or(other),
    };
    taceva_core::shown(known).to_string()
}

struct Element {
    id: u32,
    body: u64,
    end: u64,
}

impl Element {
    /// Reads the content of a small element.
    fn bytes(&self, source: &Source) -> Result<Vec<u8>, VideoError> {
        source.read(self.body, self.end - self.body, "bytes of a name", 256)
    }
}

/// Consecutive elements.
struct Elements<'a> {
    source: &'a Source,
    at: u64,
    end: u64,
    left: &'a mut u32,
}

impl<'a> Elements<'a> {
    fn new(source: &'a Source, at: u64, end: u64, left: &'a mut u32) -> Elements<'a> {
        Elements {
            source,
            at,
            end,
            left,
        }
    }

    /// Descends into `element`, the last returned element, so that its children are returned next.
    fn enter(&mut self, element: &Element) {
        self.at = element.body;
    }

    fn next(&mut self) -> Result<Option<Element>, VideoError> {
        let Some(left) = self.left.checked_sub(1).filter(|_| self.at < self.end) else {
            return Ok(None);
        };
        *self.left = left;
        let (Some((id, id_bytes)), at) = (self.number(self.at, false)?, self.at) else {
            return Ok(None);
        };
        let Some((size, size_bytes)) = self.number(at + id_bytes, true)? else {
            return Ok(None);
        };
        let body = at + id_bytes + size_bytes;
        // A size of all ones is unknown. The element then extends to the end.
        let is_unknown = size == (1 << (7 * size_bytes)) - 1;
        let end = if is_unknown {
            self.end
        } else {
            body.saturating_add(size).min(self.end)
        };
        self.at = end.max(body);
        let id = u32::try_from(id).unwrap_or(0);
        Ok(Some(Element {
            id,
            body,
            end: end.max(body),
        }))
    }

    /// Variable-length number, and its length in bytes, which the leading zeros of the first byte state. `is_size` removes the length marker.
    fn number(&self, at: u64, is_size: bool) -> Result<Option<(u64, u64)>, VideoError> {
        let mut first = [0];
        if at >= self.end {
            return Ok(None);
        }
        self.source.read_into(at, &mut first)?;
        let length = u64::from(first[0].leading_zeros()) + 1;
        if length > 8 || at + length > self.end {
            return Ok(None);
        }
        let mut bytes = [0; 8];
        let bytes = &mut bytes[..usize::try_from(length).unwrap_or(8)];
        self.source.read_into(at, bytes)?;
        if is_size {
            bytes[0] &= 0xff_u8
                .checked_shr(u32::try_from(length).unwrap_or(8))
                .unwrap_or(0);
        }
        let number = bytes
            .iter()
            .fold(0, |number, byte| number << 8 | u64::from(*byte));
        Ok(Some((number, length)))
    }
}
