//! Choice of the decoder of a clip by its container.

use std::path::Path;

use super::{Decoders, Frames};
use crate::av1::{self, Av1Clip};
use crate::avi::{self, Avi};
use crate::clip::VideoInfo;
use crate::error::VideoError;
use crate::ffmpeg::{ForeignClip, Known};
use crate::h264::{self, H264Clip};
use crate::matroska;
use crate::mp4::{self, Coding, Found, Track};
use crate::packets::{self, JpegClip, Packet};
use crate::source::Source;

type Opened = (VideoInfo, Frames);

/// Detects the container at `path` and chooses a decoder.
pub(super) fn open(path: &Path, decoders: &Decoders) -> Result<Opened, VideoError> {
    let source = Source::open(path)?;
    let mut start = [0; 16];
    let known = usize::try_from(source.length()).map_or(16, |length| length.min(16));
    source.read_into(0, &mut start[..known])?;
    let start = &start[..known];
    if avi::is_avi(start) {
        return open_avi(source, decoders);
    }
    if mp4::is_mp4(start) {
        return open_mp4(source, decoders);
    }
    if matroska::is_matroska(start) {
        let codec = matroska::codec(&source)?;
        return open_foreign(path, Known::new("Matroska", codec, ""), decoders);
    }
    if decoders.ffmpeg.is_some() {
        return open_foreign(path, Known::default(), decoders);
    }
    Err(source.damaged(
        0,
        "unknown video container, expected AVI, MP4, QuickTime or Matroska; others need ffmpeg",
    ))
}

/// Opens a clip with ffmpeg; an error if ffmpeg is not available.
fn open_foreign(path: &Path, known: Known, decoders: &Decoders) -> Result<Opened, VideoError> {
    let Some(program) = &decoders.ffmpeg else {
        return Err(known.no_decoder(path));
    };
    let (info, clip) = ForeignClip::open(path, program, &known)?;
    Ok((info, Frames::Foreign(clip)))
}

fn open_avi(source: Source, decoders: &Decoders) -> Result<Opened, VideoError> {
    let clip = Avi::read(&source)?;
    if !clip.is_motion_jpeg() {
        return open_foreign(
            source.path(),
            Known::new("AVI", Some(clip.codec()), ""),
            decoders,
        );
    }
    let info = VideoInfo {
        container: "AVI".to_owned(),
        codec: "MJPEG".to_owned(),
        pixel_format: String::new(),
        width: clip.stream.width,
        height: clip.stream.height,
        frames: clip.packets.len() as u64,
        times_s: clip.times_s(),
        lossy: Some(true),
        decoder: None,
    };
    of_jpegs(source, info, clip.packets, decoders)
}

fn open_mp4(source: Source, decoders: &Decoders) -> Result<Opened, VideoError> {
    let mut track = match mp4::read(&source)? {
        Found::Track(track) => track,
        Found::Elsewhere { codec, why } => {
            return open_foreign(source.path(), Known::new("MP4", Some(codec), why), decoders);
        }
    };
    let info = VideoInfo {
        container: "MP4".to_owned(),
        codec: track.entry.coding.name(),
        pixel_format: String::new(),
        width: track.entry.width,
        height: track.entry.height,
        frames: track.presented.len() as u64,
        times_s: Some(std::mem::take(&mut track.times_s)),
        lossy: Some(true),
        decoder: None,
    };
    match track.entry.coding.clone() {
        Coding::Jpeg => {
            let packets = packets_of(&track);
            of_jpegs(source, info, packets, decoders)
        }
        Coding::H264(settings, offset) => {
            let (clip, foreign) = H264Clip::open(source, track, &settings, offset)?;
            let codec = clip.sequence.codec();
            if let Some(why) = foreign {
                let known = Known::new("MP4", Some(codec), why);
                return open_foreign(clip.source().path(), known, decoders);
            }
            let (width, height) = clip.size();
            let info = VideoInfo {
                codec,
                pixel_format: clip.sequence.pixel_format(),
                width,
                height,
                decoder: Some(h264::DECODER.to_owned()),
                ..info
            };
            let frames = Frames::H264 {
                clip: Box::new(clip),
                else_by: decoders.ffmpeg.clone(),
            };
            Ok((info, frames))
        }
        Coding::Av1(settings) => {
            let format = Av1Clip::pixel_format(&settings);
            let (Some(format), Some(program)) = (format, &decoders.av1) else {
                let why = if format.is_some() {
                    ""
                } else {
                    "other than 8-bit 4:2:0"
                };
                return open_foreign(
                    source.path(),
                    Known::new("MP4", Some(info.codec), why),
                    decoders,
                );
            };
            let clip = Av1Clip::open(source, track, &settings, program)?;
            let info = VideoInfo {
                pixel_format: format.to_owned(),
                lossy: None,
                decoder: Some(av1::DECODER.to_owned()),
                ..info
            };
            Ok((info, Frames::Av1(Box::new(clip))))
        }
        Coding::Other(codec) => {
            open_foreign(source.path(), Known::new("MP4", Some(codec), ""), decoders)
        }
    }
}

/// Packets of a track in presentation order.
fn packets_of(track: &Track) -> Vec<Packet> {
    let samples = track
        .presented
        .iter()
        .map(|number| track.samples[*number as usize]);
    let packet = |sample: mp4::Sample| Packet {
        offset: sample.offset,
        size: u64::from(sample.size),
    };
    samples.map(packet).collect()
}

/// Opens a clip of JPEG packets. If a frame consists of two fields, ffmpeg combines the fields.
fn of_jpegs(
    source: Source,
    info: VideoInfo,
    packets: Vec<Packet>,
    decoders: &Decoders,
) -> Result<Opened, VideoError> {
    let Some(&first) = packets.first() else {
        return Err(source.damaged(source.length(), "the clip has no frame"));
    };
    let (_, header) = packets::read_packet(&source, first)?;
    let VideoInfo { width, height, .. } = info;
    if (header.width, u64::from(header.height) * 2) == (width, u64::from(height)) {
        let container = if info.container == "AVI" {
            "AVI"
        } else {
            "MP4"
        };
        let known = Known::new(container, Some(info.codec), "of two fields a frame");
        return open_foreign(source.path(), known, decoders);
    }
    let info = VideoInfo {
        pixel_format: header.pixel_format.to_owned(),
        ..info
    };
    let clip = JpegClip {
        source,
        packets,
        width,
        height,
    };
    Ok((info, Frames::Jpeg(clip)))
}
