//! MP4 and QuickTime files: the first video track, with its samples in decoding and presentation order.
//!
//! All values are checked against the length of the file and against other tables. Encrypted files, and files with several edits or descriptions, are left to
//! ffmpeg.

mod boxes;
mod edits;
mod entry;
mod fragments;
mod samples;

use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

use boxes::{BoxAt, Boxes};
use edits::Edit;

pub(crate) use entry::{Coding, Entry};
pub(crate) use samples::Sample;

/// Video track of a file.
#[derive(Debug)]
pub(crate) struct Track {
    pub(crate) entry: Entry,
    /// Samples in decoding order.
    pub(crate) samples: Vec<Sample>,
    /// Sample indices in presentation order.
    pub(crate) presented: Vec<u32>,
    /// Time of each presented sample, s.
    pub(crate) times_s: Vec<f64>,
}

/// Result of reading a file.
#[derive(Debug)]
pub(crate) enum Found {
    Track(Track),
    /// Track that only ffmpeg can read: its codec and the reason.
    Elsewhere {
        codec: String,
        why: &'static str,
    },
}

/// True if a file that begins with `start` is an MP4 or QuickTime file.
pub(crate) fn is_mp4(start: &[u8]) -> bool {
    let kind = start.get(4..8).unwrap_or_default();
    [b"ftyp", b"moov", b"mdat", b"wide", b"skip", b"free"]
        .iter()
        .any(|known| kind == *known)
}

/// Finds the first video track.
pub(crate) fn read(source: &Source) -> Result<Found, VideoError> {
    let mut boxes = Boxes::of_file(source);
    let (mut movie, mut has_fragments) = (None, false);
    while let Some(found) = boxes.next()? {
        match &found.kind {
            b"moov" => movie = Some(found),
            b"moof" => has_fragments = true,
            _ => {}
        }
    }
    let Some(movie) = movie else {
        return Err(source.damaged(
            source.length(),
            "the file ends without its tables (`moov`): it is truncated, or its recording was never closed",
        ));
    };
    has_fragments |= movie.find(source, b"mvex")?.is_some();
    let ticks_per_s = time_scale(source, &movie.need(source, b"mvhd")?)?;
    let mut tracks = movie.boxes(source, 0);
    while let Some(track) = tracks.next()? {
        if &track.kind == b"trak"
            && let Some(found) = read_track(source, &movie, &track, ticks_per_s, has_fragments)?
        {
            return Ok(found);
        }
    }
    Err(source.damaged(movie.at, "the file has no video track"))
}

/// Reads a track; `None` if it is not video.
fn read_track(
    source: &Source,
    movie: &BoxAt,
    track: &BoxAt,
    movie_ticks_per_s: u32,
    has_fragments: bool,
) -> Result<Option<Found>, VideoError> {
    let media = track.need(source, b"mdia")?;
    let handler = media.need(source, b"hdlr")?;
    let mut handler = handler.fields(source, "bytes of a handler", limits::HEADER_BYTES)?;
    handler.skip(source, 8)?;
    if &handler.take::<4>(source)? != b"vide" {
        return Ok(None);
    }
    let ticks_per_s = time_scale(source, &media.need(source, b"mdhd")?)?;
    let information = media.need(source, b"minf")?;
    let tables = information.need(source, b"stbl")?;
    let entry = entry::read(source, &tables.need(source, b"stsd")?)?;
    let elsewhere = |why| {
        let codec = entry.coding.name();
        Ok(Some(Found::Elsewhere { codec, why }))
    };
    if entry.count != 1 {
        return elsewhere("with several descriptions of its frames");
    }
    if matches!(entry.coding, Coding::Other(_)) {
        return elsewhere("");
    }
    entry::check_is_in_file(source, &information)?;
    let edit = match track.find(source, b"edts")? {
        Some(edits) => edits::read(source, &edits)?,
        None => Some(Edit::default()),
    };
    let Some(edit) = edit else {
        return elsewhere("with several edits or another speed");
    };
    let mut samples = samples::read(source, &tables)?;
    if has_fragments {
        let number = track_number(source, &track.need(source, b"tkhd")?)?;
        if !fragments::append(source, movie, number, &mut samples)? {
            return elsewhere("in fragments without offsets or times of their frames");
        }
    }
    let (presented, times_s) = present(&samples, edit, ticks_per_s, movie_ticks_per_s);
    if presented.is_empty() {
        return Err(source.damaged(track.at, "the clip presents no frame"));
    }
    Ok(Some(Found::Track(Track {
        entry,
        samples,
        presented,
        times_s,
    })))
}

/// Ticks per second, from the header of a movie or a track.
fn time_scale(source: &Source, header: &BoxAt) -> Result<u32, VideoError> {
    let mut fields = header.fields(source, "bytes of a header", limits::HEADER_BYTES)?;
    let times = match fields.version(source)? {
        1 => 16,
        _ => 8,
    };
    fields.skip(source, times)?;
    let at = fields.offset();
    match fields.u32(source)? {
        0 => Err(source.damaged(at, "the time scale is 0 ticks per second")),
        ticks => Ok(ticks),
    }
}

/// Number of a track in fragments, from its header.
fn track_number(source: &Source, header: &BoxAt) -> Result<u32, VideoError> {
    let mut fields = header.fields(source, "bytes of a header", limits::HEADER_BYTES)?;
    let times = match fields.version(source)? {
        1 => 16,
        _ => 8,
    };
    fields.skip(source, times)?;
    fields.u32(source)
}

/// Sample indices and times, s, of the samples that the edit presents, ordered by time.
fn present(
    samples: &[Sample],
    edit: Edit,
    ticks_per_s: u32,
    movie_ticks_per_s: u32,
) -> (Vec<u32>, Vec<f64>) {
    let (ticks, movie_ticks) = (i128::from(ticks_per_s), i128::from(movie_ticks_per_s));
    let from = i128::from(edit.from);
    // Rounded to the nearest tick of the track.
    let end = edit
        .duration
        .map(|duration| from + (i128::from(duration) * ticks + movie_ticks / 2) / movie_ticks);
    let mut presented: Vec<(i64, u32)> = (0..)
        .zip(samples)
        .map(|(number, sample)| (sample.time, number))
        .filter(|(time, _)| {
            i128::from(*time) >= from && end.is_none_or(|end| i128::from(*time) < end)
        })
        .collect();
    presented.sort_by_key(|(time, _)| *time);
    let delay_s = edit.delay as f64 / f64::from(movie_ticks_per_s);
    let seconds = |time: i64| delay_s + (i128::from(time) - from) as f64 / f64::from(ticks_per_s);
    presented
        .into_iter()
        .map(|(time, number)| (number, seconds(time)))
        .unzip()
}
