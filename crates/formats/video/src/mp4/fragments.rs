//! Samples of fragmented MP4 files, in which each fragment has separate tables.

use super::boxes::{BoxAt, Boxes, Fields};
use super::samples::{Sample, too_many};
use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

/// Defaults for samples whose fragment states no values.
#[derive(Clone, Copy, Debug, Default)]
struct Defaults {
    duration: u32,
    size: u32,
    flags: u32,
}

/// Flag of a sample at which decoding cannot begin.
const IS_NO_SYNC: u32 = 0x1_0000;

/// Appends the samples of the track `number` in all fragments of the file. Returns false if only ffmpeg can read the fragments.
pub(super) fn append(
    source: &Source,
    movie: &BoxAt,
    number: u32,
    samples: &mut Vec<Sample>,
) -> Result<bool, VideoError> {
    let mut reader = Reader {
        source,
        number,
        defaults: defaults(source, movie, number)?,
        bytes: 0,
        samples,
    };
    let mut boxes = Boxes::of_file(source);
    while let Some(found) = boxes.next()? {
        if &found.kind == b"moof" && !reader.fragment(&found)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Reads the defaults of the track `number`.
fn defaults(source: &Source, movie: &BoxAt, number: u32) -> Result<Defaults, VideoError> {
    let Some(extends) = movie.find(source, b"mvex")? else {
        return Ok(Defaults::default());
    };
    let mut boxes = extends.boxes(source, 0);
    while let Some(found) = boxes.next()? {
        if &found.kind != b"trex" {
            continue;
        }
        let mut fields = fields_of(source, &found)?;
        fields.skip(source, 4)?;
        if fields.u32(source)? == number {
            fields.skip(source, 4)?;
            return Ok(Defaults {
                duration: fields.u32(source)?,
                size: fields.u32(source)?,
                flags: fields.u32(source)?,
            });
        }
    }
    Ok(Defaults::default())
}

fn fields_of(source: &Source, found: &BoxAt) -> Result<Fields, VideoError> {
    found.fields(source, "bytes of a fragment's table", limits::FRAMES * 16)
}

/// Reads the flags of a box.
fn flags_of(source: &Source, fields: &mut Fields) -> Result<u32, VideoError> {
    Ok(fields.u32(source)? & 0xff_ffff)
}

struct Reader<'a> {
    source: &'a Source,
    number: u32,
    defaults: Defaults,
    /// Total size of the samples read, bytes; at most the size of the file, because samples cannot overlap.
    bytes: u64,
    samples: &'a mut Vec<Sample>,
}

impl Reader<'_> {
    fn fragment(&mut self, fragment: &BoxAt) -> Result<bool, VideoError> {
        let mut boxes = fragment.boxes(self.source, 0);
        let mut is_first = true;
        while let Some(found) = boxes.next()? {
            if &found.kind != b"traf" {
                continue;
            }
            if !self.track(fragment, &found, is_first)? {
                return Ok(false);
            }
            is_first = false;
        }
        Ok(true)
    }

    /// Reads the part of a fragment for one track.
    fn track(
        &mut self,
        fragment: &BoxAt,
        track: &BoxAt,
        is_first: bool,
    ) -> Result<bool, VideoError> {
        let source = self.source;
        let mut fields = fields_of(source, &track.need(source, b"tfhd")?)?;
        let flags = flags_of(source, &mut fields)?;
        if fields.u32(source)? != self.number {
            return Ok(true);
        }
        let base = match flags & 1 {
            0 => fragment.at,
            _ => fields.u64(source)?,
        };
        // Without a base offset, the samples would follow the frames of another track.
        if flags & 0x2_0001 == 0 && !is_first {
            return Ok(false);
        }
        let description = fields.offset();
        if flags & 2 != 0 && fields.u32(source)? != 1 {
            return Err(source.damaged(description, "frames of a second description"));
        }
        let mut defaults = self.defaults;
        for (flag, value) in [
            (0x8, &mut defaults.duration),
            (0x10, &mut defaults.size),
            (0x20, &mut defaults.flags),
        ] {
            if flags & flag != 0 {
                *value = fields.u32(source)?;
            }
        }
        let Some(time) = track.find(source, b"tfdt")? else {
            return Ok(false);
        };
        let mut fields = fields_of(source, &time)?;
        let time_at = fields.offset();
        let time = match fields.version(source)? {
            1 => fields.u64(source)?,
            _ => u64::from(fields.u32(source)?),
        };
        let Ok(mut time) = i64::try_from(time) else {
            return Err(source.damaged(time_at, "times that are too large"));
        };
        let mut offset = base;
        let mut boxes = track.boxes(source, 0);
        while let Some(found) = boxes.next()? {
            if &found.kind == b"trun" {
                self.run(&found, base, defaults, &mut offset, &mut time)?;
            }
        }
        Ok(true)
    }

    /// Reads a run of consecutive samples.
    fn run(
        &mut self,
        run: &BoxAt,
        base: u64,
        defaults: Defaults,
        offset: &mut u64,
        time: &mut i64,
    ) -> Result<(), VideoError> {
        let source = self.source;
        let mut fields = fields_of(source, run)?;
        let flags = flags_of(source, &mut fields)?;
        let count = fields.u32(source)?;
        if flags & 1 != 0 {
            let at = fields.offset();
            let from = i64::from(i32::from_be_bytes(fields.take(source)?));
            *offset = base
                .checked_add_signed(from)
                .ok_or_else(|| source.damaged(at, "frames before the beginning of the file"))?;
        }
        let first_flags = match flags & 4 {
            0 => None,
            _ => Some(fields.u32(source)?),
        };
        for place in 0..count {
            let at = fields.offset();
            let mut own = |flag, default| match flags & flag {
                0 => Ok(default),
                _ => fields.u32(source),
            };
            let duration = own(0x100, defaults.duration)?;
            let size = own(0x200, defaults.size)?;
            let sample_flags = own(0x400, defaults.flags)?;
            // Signed, as in the tables of whole files.
            let delay = i64::from(own(0x800, 0)?.cast_signed());
            let sample_flags = first_flags.filter(|_| place == 0).unwrap_or(sample_flags);
            let end = offset
                .checked_add(u64::from(size))
                .filter(|end| *end <= source.length());
            self.bytes += u64::from(size);
            let Some(end) = end.filter(|_| size > 0 && self.bytes <= source.length()) else {
                let problem = format!(
                    "a frame of {size} bytes at byte {offset} extends past the end of the file, which has {} bytes",
                    source.length()
                );
                return Err(source.damaged(at, problem));
            };
            if self.samples.len() as u64 == limits::FRAMES {
                return Err(too_many(source, limits::FRAMES + 1));
            }
            let beyond = || source.damaged(at, "times that are too large");
            self.samples.push(Sample {
                offset: *offset,
                size,
                is_sync: sample_flags & IS_NO_SYNC == 0,
                time: time.checked_add(delay).ok_or_else(beyond)?,
            });
            *offset = end;
            *time = time.checked_add(i64::from(duration)).ok_or_else(beyond)?;
        }
        Ok(())
    }
}
