//! Units of an H.264 stream, with length prefixes in MP4 and start codes for decoders.

use super::parameters::Sequence;
use crate::error::VideoError;
use crate::source::Source;

/// Settings of an H.264 stream, from the MP4 box `avcC`.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    /// Size of the length prefix of a unit, bytes: 1, 2 or 4.
    length_bytes: usize,
    /// All parameter sets, with start codes.
    pub(super) parameters: Vec<u8>,
    /// First sequence parameter set, if any.
    pub(super) sequence: Option<Sequence>,
}

/// Kind of a unit of an H.264 stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UnitKind {
    /// Part of a picture.
    Slice,
    /// Part of a picture at which decoding can begin.
    KeySlice,
    /// Sequence parameter set.
    Sequence,
    /// Any other unit.
    Other,
}

impl UnitKind {
    pub(super) fn of(first: u8) -> UnitKind {
        match first & 31 {
            1..=4 => UnitKind::Slice,
            5 => UnitKind::KeySlice,
            7 => UnitKind::Sequence,
            _ => UnitKind::Other,
        }
    }
}

impl Settings {
    /// Parses the settings `bytes`, which are at `offset` in the file.
    pub(super) fn read(source: &Source, bytes: &[u8], offset: u64) -> Result<Settings, VideoError> {
        let wrong = |at: usize, problem: &str| {
            source.damaged(offset + at as u64, format!("settings of H.264: {problem}"))
        };
        let &[version, _, _, _, lengths, counts, ..] = bytes else {
            return Err(wrong(0, "cut"));
        };
        if version != 1 {
            return Err(wrong(0, "unknown version, expected 1"));
        }
        let length_bytes = usize::from(lengths & 3) + 1;
        if length_bytes == 3 {
            return Err(wrong(4, "the lengths have 3 bytes, expected 1, 2 or 4"));
        }
        let mut settings = Settings {
            length_bytes,
            parameters: Vec::new(),
            sequence: None,
        };
        let mut at = 6;
        for _ in 0..counts & 31 {
            let unit = sized(bytes, &mut at).ok_or_else(|| wrong(at, "cut"))?;
            let sequence = Sequence::read(unit)
                .ok_or_else(|| wrong(at, "a sequence parameter set has an unknown layout"))?;
            match &settings.sequence {
                None => settings.sequence = Some(sequence),
                Some(first) if (first.width, first.height) == (sequence.width, sequence.height) => {
                }
                Some(_) => return Err(wrong(at, "the sequences have different sizes")),
            }
            push_unit(&mut settings.parameters, unit);
        }
        let count = *bytes.get(at).ok_or_else(|| wrong(at, "cut"))?;
        at += 1;
        for _ in 0..count {
            let unit = sized(bytes, &mut at).ok_or_else(|| wrong(at, "cut"))?;
            push_unit(&mut settings.parameters, unit);
        }
        Ok(settings)
    }

    /// Units of the sample `bytes` at `offset`, each with its offset in the file.
    pub(super) fn units<'a>(
        &self,
        source: &Source,
        bytes: &'a [u8],
        offset: u64,
    ) -> Result<Vec<(u64, &'a [u8])>, VideoError> {
        let mut units = Vec::new();
        let mut at = 0;
        while at < bytes.len() {
            let wrong = |problem: String| source.damaged(offset + at as u64, problem);
            let head = bytes.get(at..at + self.length_bytes);
            let head =
                head.ok_or_else(|| wrong("a frame ends within the length of a unit".to_owned()))?;
            let length = head
                .iter()
                .fold(0_usize, |length, byte| length << 8 | usize::from(*byte));
            let from = at + self.length_bytes;
            let unit = from
                .checked_add(length)
                .and_then(|end| bytes.get(from..end));
            let Some(unit) = unit else {
                let left = bytes.len() - from;
                return Err(wrong(format!(
                    "a unit of {length} bytes, but the frame has {left} left"
                )));
            };
            if let Some(inner) = unit.windows(3).position(|three| three == [0, 0, 1]) {
                return Err(source.damaged(
                    offset + (from + inner) as u64,
                    "a unit contains a start code",
                ));
            }
            if !unit.is_empty() {
                units.push((offset + from as u64, unit));
            }
            at = from + length;
        }
        Ok(units)
    }

    /// True if decoding can begin at the sample of `size` bytes at `offset`.
    pub(super) fn is_key(
        &self,
        source: &Source,
        offset: u64,
        size: u32,
    ) -> Result<bool, VideoError> {
        let mut at = 0_u64;
        let mut head = [0; 5];
        let head = &mut head[..=self.length_bytes];
        while at + (head.len() as u64) <= u64::from(size) {
            source.read_into(offset + at, head)?;
            let (first, length) = (head[self.length_bytes], &head[..self.length_bytes]);
            let length = length
                .iter()
                .fold(0_u64, |length, byte| length << 8 | u64::from(*byte));
            match UnitKind::of(first) {
                UnitKind::KeySlice => return Ok(true),
                UnitKind::Slice => return Ok(false),
                UnitKind::Sequence | UnitKind::Other => at += self.length_bytes as u64 + length,
            }
        }
        Ok(false)
    }
}

/// Appends a unit with a start code.
pub(super) fn push_unit(stream: &mut Vec<u8>, unit: &[u8]) {
    stream.extend_from_slice(&[0, 0, 0, 1]);
    stream.extend_from_slice(unit);
}

/// Bytes that follow a length of two bytes. Advances `at` past them. `None` if the bytes are truncated.
fn sized<'a>(bytes: &'a [u8], at: &mut usize) -> Option<&'a [u8]> {
    let length = bytes.get(*at..*at + 2)?;
    let length = usize::from(u16::from_be_bytes([length[0], length[1]]));
    let unit = bytes.get(*at + 2..*at + 2 + length)?;
    *at += 2 + length;
    Some(unit)
}
