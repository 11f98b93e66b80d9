//! Sequence parameter sets of H.264: properties of a stream that are needed before decoding.

use super::bits::Bits;

/// Contents of a sequence parameter set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Sequence {
    profile: u32,
    /// Chroma format: 0 for gray, 1 for 4:2:0, 2 for 4:2:2, 3 for 4:4:4.
    chroma: u32,
    luma_bits: u32,
    chroma_bits: u32,
    reference_frames: u32,
    /// Number of macroblocks of 16×16 pixels in a frame.
    blocks: u64,
    has_fields: bool,
    is_cut_left_or_top: bool,
    has_order_by_cycle: bool,
    /// Width and height of the shown picture, pixels.
    pub(super) width: u32,
    pub(super) height: u32,
    /// True for samples from 0 to 255; `None` if the stream states no range.
    pub(super) is_full_range: Option<bool>,
    /// Matrix number of ITU-T H.273; `None` if the stream states none.
    pub(super) matrix: Option<u16>,
}

/// Limits of level 6.2 (ITU-T H.264, table A-1): macroblocks of one frame, and macroblocks of all reference frames.
const MOST_BLOCKS: u64 = 139_264;
const MOST_KEPT_BLOCKS: u64 = 696_320;

impl Sequence {
    /// Parses the unit `unit`; `None` if it is truncated or invalid.
    pub(super) fn read(unit: &[u8]) -> Option<Sequence> {
        let mut bits = Bits::new(unit);
        let profile = bits.bits(8)?;
        bits.bits(16)?;
        bits.unsigned()?;
        let (mut chroma, mut luma_bits, mut chroma_bits) = (1, 8, 8);
        if matches!(
            profile,
            100 | 110 | 122 | 244 | 44 | 83 | 86 | 118 | 128 | 138 | 139 | 134 | 135
        ) {
            chroma = bits.unsigned().filter(|chroma| *chroma <= 3)?;
            if chroma == 3 {
                bits.bit()?;
            }
            luma_bits = 8 + bits.unsigned().filter(|more| *more <= 6)?;
            chroma_bits = 8 + bits.unsigned().filter(|more| *more <= 6)?;
            bits.bit()?;
            if bits.bit()? {
                skip_scaling(&mut bits, if chroma == 3 { 12 } else { 8 })?;
            }
        }
        bits.unsigned()?;
        let order = bits.unsigned().filter(|order| *order <= 2)?;
        match order {
            0 => {
                bits.unsigned()?;
            }
            1 => {
                bits.bit()?;
                bits.signed()?;
                bits.signed()?;
                for _ in 0..bits.unsigned().filter(|count| *count <= 255)? {
                    bits.signed()?;
                }
            }
            _ => {}
        }
        let reference_frames = bits.unsigned().filter(|count| *count <= 16)?;
        bits.bit()?;
        let columns = u64::from(bits.unsigned()?) + 1;
        let rows = u64::from(bits.unsigned()?) + 1;
        let has_frames_alone = bits.bit()?;
        if !has_frames_alone {
            bits.bit()?;
        }
        bits.bit()?;
        let rows = rows * if has_frames_alone { 1 } else { 2 };
        let blocks = columns.checked_mul(rows)?;
        let (unit_x, unit_y) = match chroma {
            1 => (2, 2),
            2 => (2, 1),
            _ => (1, 1),
        };
        let unit_y = unit_y * if has_frames_alone { 1 } else { 2 };
        let mut cut = [0; 4];
        if bits.bit()? {
            for side in &mut cut {
                *side = u64::from(bits.unsigned()?);
            }
        }
        let [left, right, top, bottom] = cut;
        let width = (columns * 16).checked_sub(unit_x * (left + right))?;
        let height = (rows * 16).checked_sub(unit_y * (top + bottom))?;
        let (is_full_range, matrix) = match bits.bit()? {
            true => read_colours(&mut bits)?,
            false => (None, None),
        };
        Some(Sequence {
            profile,
            chroma,
            luma_bits,
            chroma_bits,
            reference_frames,
            blocks,
            has_fields: !has_frames_alone,
            is_cut_left_or_top: left > 0 || top > 0,
            has_order_by_cycle: order == 1,
            width: u32::try_from(width).ok().filter(|width| *width > 0)?,
            height: u32::try_from(height).ok().filter(|height| *height > 0)?,
            is_full_range,
            matrix,
        })
    }

    /// Name of the codec, with its profile.
    pub(crate) fn codec(&self) -> String {
        let profile = match self.profile {
            66 => "Baseline",
            77 => "Main",
            88 => "Extended",
            100 => "High",
            110 => "High 10",
            122 => "High 4:2:2",
            244 => "High 4:4:4 Predictive",
            other => return format!("H.264 of profile {other}"),
        };
        format!("H.264 {profile}")
    }

    /// Pixel format as FFmpeg names it.
    pub(crate) fn pixel_format(&self) -> String {
        let planes = match self.chroma {
            0 => "gray",
            1 => "yuv420p",
            2 => "yuv422p",
            _ => "yuv444p",
        };
        match self.luma_bits {
            8 => planes.to_owned(),
            bits => format!("{planes}{bits}le"),
        }
    }

    /// Reason why this process cannot decode the stream; `None` if it can.
    pub(super) fn foreign(&self) -> Option<&'static str> {
        if self.chroma != 1 {
            Some("other than 4:2:0")
        } else if self.luma_bits != 8 || self.chroma_bits != 8 {
            Some("of more than 8 bits")
        } else if !matches!(self.profile, 66 | 77 | 100 | 110) {
            Some("of a rare profile")
        } else if self.has_fields {
            Some("with fields")
        } else if self.is_cut_left_or_top {
            Some("cropped at its left or top")
        } else if self.has_order_by_cycle {
            Some("with picture order count type 1")
        } else {
            None
        }
    }

    /// True if the stream exceeds every level of the standard.
    pub(super) fn is_too_large(&self) -> bool {
        let kept = self
            .blocks
            .saturating_mul(u64::from(self.reference_frames) + 1);
        self.blocks > MOST_BLOCKS || kept > MOST_KEPT_BLOCKS + self.blocks
    }
}

fn skip_scaling(bits: &mut Bits, lists: usize) -> Option<()> {
    for list in 0..lists {
        if !bits.bit()? {
            continue;
        }
        let (mut last, mut next) = (8, 8);
        for _ in 0..if list < 6 { 16 } else { 64 } {
            if next != 0 {
                next = (last + bits.signed()?).rem_euclid(256);
            }
            if next != 0 {
                last = next;
            }
        }
    }
    Some(())
}

/// Parses range and matrix of the video usability information.
fn read_colours(bits: &mut Bits) -> Option<(Option<bool>, Option<u16>)> {
    if bits.bit()? && bits.bits(8)? == 255 {
        bits.bits(32)?;
    }
    if bits.bit()? {
        bits.bit()?;
    }
    if !bits.bit()? {
        return Some((None, None));
    }
    bits.bits(3)?;
    let is_full_range = bits.bit()?;
    if !bits.bit()? {
        return Some((Some(is_full_range), None));
    }
    bits.bits(16)?;
    let matrix = u16::try_from(bits.bits(8)?).ok()?;
    Some((Some(is_full_range), Some(matrix)))
}
