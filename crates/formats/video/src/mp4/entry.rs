//! Sample description of a track: the coding of its frames.

use super::boxes::{BoxAt, Boxes, Fields};
use crate::error::VideoError;
use crate::limits;
use crate::source::Source;

/// Description of the samples of a track.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// Number of sample descriptions of the track. Only the first is read.
    pub(super) count: u32,
    pub(crate) coding: Coding,
    /// Width and height that the container states, pixels.
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// Colours that the container states; `None` if it states none.
    pub(crate) colour: Option<ColourTag>,
}

/// Codec with the settings for its decoder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Coding {
    /// H.264: the content of `avcC` and its offset.
    H264(Vec<u8>, u64),
    /// AV1: the content of `av1C`.
    Av1(Vec<u8>),
    /// One JPEG for each sample.
    Jpeg,
    /// Another codec, by its name.
    Other(String),
}

impl Coding {
    pub(crate) fn name(&self) -> String {
        match self {
            Coding::H264(..) => "H.264".to_owned(),
            Coding::Av1(_) => "AV1".to_owned(),
            Coding::Jpeg => "MJPEG".to_owned(),
            Coding::Other(name) => name.clone(),
        }
    }
}

/// Matrix and range of colours, as numbers of ITU-T H.273.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ColourTag {
    pub(crate) matrix: u16,
    pub(crate) is_full_range: bool,
}

/// Reads the first description of the box `stsd`.
pub(super) fn read(source: &Source, descriptions: &BoxAt) -> Result<Entry, VideoError> {
    let mut fields = descriptions.fields(source, "bytes of a description", limits::HEADER_BYTES)?;
    fields.version(source)?;
    let count = fields.u32(source)?;
    let Some(found) = descriptions.boxes(source, 8).next()? else {
        return Err(source.damaged(
            descriptions.at,
            "the track has no description of its frames",
        ));
    };
    // Fields of all pictures: 24 bytes before their size, 50 after it.
    let mut fields = found.fields(source, "bytes of a description", limits::HEADER_BYTES)?;
    fields.skip(source, 24)?;
    let at = fields.offset();
    let (width, height) = (
        u32::from(fields.u16(source)?),
        u32::from(fields.u16(source)?),
    );
    if !(1..=limits::SIDE).contains(&width) || !(1..=limits::SIDE).contains(&height) {
        let problem = format!(
            "frames of {width}×{height}, expected sides of 1 to {}",
            limits::SIDE
        );
        return Err(source.damaged(at, problem));
    }
    fields.skip(source, 50)?;
    let mut inner = found.boxes(source, 78);
    let (mut settings, mut colour) = (None, None);
    while let Some(part) = next_part(&mut inner)? {
        match &part.kind {
            b"avcC" | b"av1C" | b"esds" => settings = Some(part),
            b"colr" => colour = read_colour(source, &part)?,
            _ => {}
        }
    }
    Ok(Entry {
        count,
        coding: coding(source, &found, settings)?,
        width,
        height,
        colour,
    })
}

/// Returns the next part of a description. Ignores padding that is not a box, which some writers leave at the end.
fn next_part(inner: &mut Boxes<'_>) -> Result<Option<BoxAt>, VideoError> {
    match inner.next() {
        Err(VideoError::Damaged { .. }) => Ok(None),
        other => other,
    }
}

fn coding(source: &Source, found: &BoxAt, settings: Option<BoxAt>) -> Result<Coding, VideoError> {
    let content = |kind: &[u8; 4]| {
        let settings = settings.filter(|settings| &settings.kind == kind);
        let Some(settings) = settings else {
            let problem = format!(
                "the description has no settings (`{}`)",
                kind.escape_ascii()
            );
            return Err(source.damaged(found.at, problem));
        };
        let bytes = source.read(
            settings.body,
            settings.size(),
            "bytes of a decoder's settings",
            limits::HEADER_BYTES,
        )?;
        Ok((bytes, settings.body))
    };
    let other = |name: &str| Ok(Coding::Other(name.to_owned()));
    match &found.kind {
        b"avc1" | b"avc3" => content(b"avcC").map(|(bytes, at)| Coding::H264(bytes, at)),
        b"av01" => content(b"av1C").map(|(bytes, _)| Coding::Av1(bytes)),
        b"jpeg" => Ok(Coding::Jpeg),
        b"mp4v" => {
            let (bytes, _) = content(b"esds")?;
            match object_type(&bytes) {
                Some(0x6c) => Ok(Coding::Jpeg),
                Some(0x60..=0x65) => other("MPEG-2"),
                Some(0x6a) => other("MPEG-1"),
                _ => other("MPEG-4 part 2"),
            }
        }
        b"hvc1" | b"hev1" => other("HEVC"),
        b"vp08" => other("VP8"),
        b"vp09" => other("VP9"),
        b"encv" => other("an encrypted codec"),
        b"apcn" | b"apch" | b"apcs" | b"apco" | b"ap4h" | b"ap4x" => other("ProRes"),
        kind => Ok(Coding::Other(format!("`{}`", kind.escape_ascii()))),
    }
}

/// Codec number in a description of MPEG-4 systems. The description consists of nested descriptors, each with a tag and a size in groups of 7 bits.
fn object_type(bytes: &[u8]) -> Option<u8> {
    // Skips version and flags.
    let mut rest = bytes.get(4..)?;
    let mut descriptor = |tag: u8| {
        let (&found, behind) = rest.split_first()?;
        let size = behind.iter().take(4).position(|byte| byte & 0x80 == 0)?;
        rest = &behind[size + 1..];
        (found == tag).then_some(())
    };
    descriptor(3)?;
    let flags = *rest.get(2)?;
    let skipped = 3 + if flags & 0x80 != 0 { 2 } else { 0 };
    if flags & 0x60 != 0 {
        return None;
    }
    let (&tag, behind) = rest.get(skipped..)?.split_first()?;
    let size = behind.iter().take(4).position(|byte| byte & 0x80 == 0)?;
    (tag == 4).then_some(())?;
    behind.get(size + 1).copied()
}

/// Reads matrix and range; `None` if the box does not state them as numbers.
fn read_colour(source: &Source, found: &BoxAt) -> Result<Option<ColourTag>, VideoError> {
    let mut fields = found.fields(
        source,
        "bytes of a colour description",
        limits::HEADER_BYTES,
    )?;
    let kind = fields.take::<4>(source)?;
    if !matches!(&kind, b"nclx" | b"nclc") {
        return Ok(None);
    }
    fields.skip(source, 4)?;
    let matrix = fields.u16(source)?;
    let is_full_range = &kind == b"nclx" && fields.byte(source)? & 0x80 != 0;
    Ok(Some(ColourTag {
        matrix,
        is_full_range,
    }))
}

/// Checks that the samples are in the file itself. `information` is the box `minf` of the track.
pub(super) fn check_is_in_file(source: &Source, information: &BoxAt) -> Result<(), VideoError> {
    let references = match information.find(source, b"dinf")? {
        Some(place) => place.find(source, b"dref")?,
        None => None,
    };
    let Some(references) = references else {
        return Ok(());
    };
    let mut inner = references.boxes(source, 8);
    while let Some(reference) = inner.next()? {
        let mut fields: Fields =
            reference.fields(source, "bytes of a reference", limits::HEADER_BYTES)?;
        let [_, _, _, flags] = fields.take(source)?;
        if flags & 1 == 0 {
            return Err(source.damaged(
                reference.at,
                "the frames are in another file: merge the files with `ffmpeg -i OLD -c copy NEW`",
            ));
        }
    }
    Ok(())
}
