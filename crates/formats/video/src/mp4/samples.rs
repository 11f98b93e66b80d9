//! Samples of a track: their locations, times and key frames.

use super::boxes::{BoxAt, Fields};
use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

/// Compressed bytes of one frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sample {
    /// Byte offset in the file.
    pub(crate) offset: u64,
    /// Size, bytes.
    pub(crate) size: u32,
    /// True if decoding can begin at this sample, as the container states.
    pub(crate) is_sync: bool,
    /// Presentation time, in ticks of the track, before edits.
    pub(crate) time: i64,
}

/// Reads the tables of the box `stbl`: samples in decoding order.
pub(super) fn read(source: &Source, tables: &BoxAt) -> Result<Vec<Sample>, VideoError> {
    let sizes = read_sizes(source, tables)?;
    let offsets = read_offsets(source, tables, &sizes)?;
    let times = read_times(source, tables, sizes.len())?;
    let mut samples: Vec<Sample> = sizes
        .iter()
        .zip(offsets)
        .zip(times)
        .map(|((&size, offset), time)| Sample {
            offset,
            size,
            is_sync: true,
            time,
        })
        .collect();
    if let Some(sync) = tables.find(source, b"stss")? {
        mark_sync(source, &sync, &mut samples)?;
    }
    Ok(samples)
}

fn table(source: &Source, found: &BoxAt) -> Result<(Fields, u8), VideoError> {
    let mut fields = found.fields(source, "bytes of a table", limits::FRAMES * 16)?;
    let version = fields.version(source)?;
    Ok((fields, version))
}

pub(super) fn too_many(source: &Source, found: u64) -> VideoError {
    VideoError::TooLarge {
        path: source.path().to_owned(),
        what: "frames of a clip",
        found,
        limit: limits::FRAMES,
    }
}

fn read_sizes(source: &Source, tables: &BoxAt) -> Result<Vec<u32>, VideoError> {
    if let Some(found) = tables.find(source, b"stz2")? {
        return read_small_sizes(source, &found);
    }
    let found = tables.need(source, b"stsz")?;
    let (mut fields, _) = table(source, &found)?;
    let each = fields.u32(source)?;
    if each > 0 {
        let at = fields.offset();
        let count = fields.u32(source)?;
        if u64::from(count) * u64::from(each) > source.length() {
            let problem = format!(
                "{count} frames of {each} bytes do not fit the file of {} bytes",
                source.length()
            );
            return Err(source.damaged(at, problem));
        }
        if u64::from(count) > limits::FRAMES {
            return Err(too_many(source, u64::from(count)));
        }
        return Ok(vec![each; count as usize]);
    }
    let count = fields.count(source, 4)?;
    if count as u64 > limits::FRAMES {
        return Err(too_many(source, count as u64));
    }
    (0..count).map(|_| fields.u32(source)).collect()
}

/// Reads sample sizes of 4, 8 or 16 bits.
fn read_small_sizes(source: &Source, found: &BoxAt) -> Result<Vec<u32>, VideoError> {
    let (mut fields, _) = table(source, found)?;
    let at = fields.offset();
    let bits = fields.u32(source)? & 0xff;
    let count = u64::from(fields.u32(source)?);
    if count > limits::FRAMES {
        return Err(too_many(source, count));
    }
    if !matches!(bits, 4 | 8 | 16) || count * u64::from(bits) > fields.left() as u64 * 8 {
        let problem = format!(
            "the table states {count} sizes of {bits} bits, expected sizes of 4, 8 or 16 bits that fit {} bytes",
            fields.left()
        );
        return Err(source.damaged(at, problem));
    }
    let mut sizes = Vec::new();
    while (sizes.len() as u64) < count {
        match bits {
            16 => sizes.push(u32::from(fields.u16(source)?)),
            8 => sizes.push(u32::from(fields.byte(source)?)),
            _ => {
                let two = fields.byte(source)?;
                sizes.extend([u32::from(two >> 4), u32::from(two & 15)]);
            }
        }
    }
    // A byte has two sizes of 4 bits. The last one may be unused.
    sizes.truncate(usize::try_from(count).unwrap_or(usize::MAX));
    Ok(sizes)
}

/// Offset of each sample, computed from the offset of each chunk and its number of samples.
fn read_offsets(source: &Source, tables: &BoxAt, sizes: &[u32]) -> Result<Vec<u64>, VideoError> {
    let (mut chunks, is_long) = match tables.find(source, b"co64")? {
        Some(found) => (table(source, &found)?.0, true),
        None => (table(source, &tables.need(source, b"stco")?)?.0, false),
    };
    let (mut runs, _) = table(source, &tables.need(source, b"stsc")?)?;
    let chunk_count = chunks.count(source, if is_long { 8 } else { 4 })?;
    let mut runs_left = runs.count(source, 12)?;
    let mut offsets = Vec::with_capacity(sizes.len());
    let mut per_chunk = 0;
    let mut next_run = match runs_left {
        0 => None,
        _ => Some(runs.u32(source)?),
    };
    for chunk in 1..=chunk_count {
        if next_run.is_some_and(|first| first as usize <= chunk) {
            let at = runs.offset();
            if next_run.is_some_and(|first| (first as usize) < chunk) {
                return Err(source.damaged(at - 4, "runs of chunks are out of order".to_owned()));
            }
            per_chunk = runs.u32(source)?;
            if runs.u32(source)? != 1 {
                return Err(source.damaged(at + 4, "frames of a second description".to_owned()));
            }
            runs_left -= 1;
            next_run = match runs_left {
                0 => None,
                _ => Some(runs.u32(source)?),
            };
        }
        let at = chunks.offset();
        let mut offset = match is_long {
            true => chunks.u64(source)?,
            false => u64::from(chunks.u32(source)?),
        };
        for _ in 0..per_chunk {
            let Some(&size) = sizes.get(offsets.len()) else {
                let problem = format!(
                    "chunks hold more frames than the {} that have a size",
                    sizes.len()
                );
                return Err(source.damaged(at, problem));
            };
            let end = offset.checked_add(u64::from(size));
            let Some(end) = end.filter(|end| *end <= source.length()) else {
                let problem = format!(
                    "frame {} of {size} bytes at byte {offset} extends past the end of the file, which has {} bytes",
                    offsets.len(),
                    source.length()
                );
                return Err(source.damaged(at, problem));
            };
            offsets.push(offset);
            offset = end;
        }
    }
    if offsets.len() != sizes.len() {
        let problem = format!(
            "{} frames have a size, but {} have an offset",
            sizes.len(),
            offsets.len()
        );
        return Err(source.damaged(tables.at, problem));
    }
    Ok(offsets)
}

/// Presentation time of each of `count` samples, in ticks of the track.
fn read_times(source: &Source, tables: &BoxAt, count: usize) -> Result<Vec<i64>, VideoError> {
    let found = tables.need(source, b"stts")?;
    let (mut fields, _) = table(source, &found)?;
    let mut times = Vec::with_capacity(count);
    let mut time = 0_i64;
    for _ in 0..fields.count(source, 8)? {
        let at = fields.offset();
        let (run, step) = (fields.u32(source)?, fields.u32(source)?);
        if run as usize > count - times.len() {
            return Err(source.damaged(at, format!("more times than the {count} frames")));
        }
        for _ in 0..run {
            times.push(time);
            time = time
                .checked_add(i64::from(step))
                .ok_or_else(|| source.damaged(at, "times that are too large"))?;
        }
    }
    if times.len() != count {
        let problem = format!("{} frames have a time, expected all {count}", times.len());
        return Err(source.damaged(found.at, problem));
    }
    if let Some(found) = tables.find(source, b"ctts")? {
        add_delays(source, &found, &mut times)?;
    }
    Ok(times)
}

/// Adds to `times` the delay between decoding and presentation of each sample, in ticks of the track.
fn add_delays(source: &Source, found: &BoxAt, times: &mut [i64]) -> Result<(), VideoError> {
    let (mut fields, _) = table(source, found)?;
    let count = times.len();
    let mut rest = times.iter_mut();
    for _ in 0..fields.count(source, 8)? {
        let at = fields.offset();
        // Signed in version 1. Some writers use signed values in version 0 too. No delay reaches 2^31 ticks.
        let (run, delay) = (
            fields.u32(source)?,
            i32::from_be_bytes(fields.take(source)?),
        );
        for _ in 0..run {
            let Some(time) = rest.next() else {
                return Err(source.damaged(at, format!("more delays than the {count} frames")));
            };
            *time = time
                .checked_add(i64::from(delay))
                .ok_or_else(|| source.damaged(at, "times that are too large"))?;
        }
    }
    match rest.len() {
        0 => Ok(()),
        left => Err(source.damaged(found.at, format!("{left} of {count} frames have no delay"))),
    }
}

fn mark_sync(source: &Source, found: &BoxAt, samples: &mut [Sample]) -> Result<(), VideoError> {
    let (mut fields, _) = table(source, found)?;
    for sample in samples.iter_mut() {
        sample.is_sync = false;
    }
    let count = samples.len();
    for _ in 0..fields.count(source, 4)? {
        let at = fields.offset();
        let number = fields.u32(source)?;
        let sample = (number as usize)
            .checked_sub(1)
            .and_then(|place| samples.get_mut(place));
        let Some(sample) = sample else {
            return Err(source.damaged(
                at,
                format!("key frame {number}, but there are {count} frames, counted from 1"),
            ));
        };
        sample.is_sync = true;
    }
    Ok(())
}
