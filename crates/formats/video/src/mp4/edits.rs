//! Edit list of a track: the part of the track that a player presents.

use super::boxes::BoxAt;
use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

/// Presented part of a track.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Edit {
    /// Delay before the presented part, in ticks of the movie.
    pub(super) delay: u64,
    /// First presented time, in ticks of the track.
    pub(super) from: i64,
    /// Duration in ticks of the movie; `None` for the rest of the track.
    pub(super) duration: Option<u64>,
}

/// Reads the edit in the box `edts` of a track; `None` for several edits or another speed.
pub(super) fn read(source: &Source, edits: &BoxAt) -> Result<Option<Edit>, VideoError> {
    let Some(list) = edits.find(source, b"elst")? else {
        return Ok(Some(Edit::default()));
    };
    let mut fields = list.fields(source, "bytes of an edit list", limits::HEADER_BYTES)?;
    let is_long = fields.version(source)? == 1;
    let mut edit = None;
    let mut delay = 0_u64;
    for _ in 0..fields.count(source, if is_long { 20 } else { 12 })? {
        let at = fields.offset();
        let (duration, from) = match is_long {
            true => (
                fields.u64(source)?,
                i64::from_be_bytes(fields.take(source)?),
            ),
            false => {
                let duration = u64::from(fields.u32(source)?);
                (
                    duration,
                    i64::from(i32::from_be_bytes(fields.take(source)?)),
                )
            }
        };
        let speed = fields.u32(source)?;
        if from == -1 && edit.is_none() {
            delay = delay
                .checked_add(duration)
                .ok_or_else(|| source.damaged(at, "the delay is too large"))?;
        } else if from >= 0 && edit.is_none() && speed == 1 << 16 {
            edit = Some(Edit {
                delay,
                from,
                duration: (duration > 0).then_some(duration),
            });
        } else {
            return Ok(None);
        }
    }
    Ok(Some(edit.unwrap_or(Edit {
        delay,
        ..Edit::default()
    })))
}
