//! H.264 of 8 bits and 4:2:0 in MP4. Samples are decoded one by one, from the key frame before the requested frame.
//!
//! Frames follow the presentation order of the container, so only frames that wait for an earlier frame are kept in memory.

mod bits;
mod parameters;
mod units;

use std::ops::ControlFlow;

use rusty_h264_decoder::{DecodeError, Decoder};

use crate::clip::{Colours, Picture};
use crate::colour::{Planes, YuvCoding};
use crate::error::VideoError;
use crate::gop::{self, SampleDecoder, Wanted};
use crate::limits;
use crate::mp4::{Sample, Track};
use crate::source::Source;

use units::{Settings, UnitKind, push_unit};

pub(crate) use parameters::Sequence;

/// Name and version of the decoder library.
pub(crate) const DECODER: &str = "rusty_h264-decoder 0.17";

/// H.264 clip, decoded in this process.
#[derive(Debug)]
pub(crate) struct H264Clip {
    source: Source,
    samples: Vec<Sample>,
    /// Sample indices in presentation order.
    presented: Vec<u32>,
    settings: Settings,
    pub(crate) sequence: Sequence,
    coding: YuvCoding,
}

/// Reason why a frame was not decoded.
pub(crate) enum Refusal {
    Video(VideoError),
    /// Feature of the codec that the decoder does not support. The text is appended to the name of the codec.
    Tool(String),
}

/// Decoded picture, with rows without padding, and chroma planes with half the width and height.
struct Decoded {
    width: usize,
    height: usize,
    luma: Vec<u8>,
    chroma: [Vec<u8>; 2],
}

impl From<VideoError> for Refusal {
    fn from(error: VideoError) -> Refusal {
        Refusal::Video(error)
    }
}

impl H264Clip {
    /// Opens the clip of a track. Also returns the reason if this process cannot decode the clip.
    pub(crate) fn open(
        source: Source,
        track: Track,
        settings: &[u8],
        offset: u64,
    ) -> Result<(H264Clip, Option<&'static str>), VideoError> {
        let settings = Settings::read(&source, settings, offset)?;
        let sequence = match &settings.sequence {
            Some(sequence) => sequence.clone(),
            None => first_sequence(&source, &settings, &track)?,
        };
        if sequence.is_too_large() {
            return Err(VideoError::TooLarge {
                path: source.path().to_owned(),
                what: "pixels of an H.264 frame",
                found: u64::from(sequence.width) * u64::from(sequence.height),
                limit: 139_264 * 256,
            });
        }
        let colour = track.entry.colour;
        let coding = YuvCoding {
            matrix: sequence.matrix.or(colour.map(|colour| colour.matrix)),
            is_full_range: sequence
                .is_full_range
                .or(colour.map(|colour| colour.is_full_range))
                .unwrap_or(false),
        };
        let foreign = sequence.foreign();
        let clip = H264Clip {
            source,
            samples: track.samples,
            presented: track.presented,
            settings,
            sequence,
            coding,
        };
        Ok((clip, foreign))
    }

    pub(crate) fn source(&self) -> &Source {
        &self.source
    }

    pub(crate) fn size(&self) -> (u32, u32) {
        (self.sequence.width, self.sequence.height)
    }

    /// Calls `each` with the frames whose indices are in `sorted`.
    pub(crate) fn visit(
        &self,
        sorted: &[u64],
        colours: Colours,
        each: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        let mut session = Session {
            clip: self,
            colours,
            decoder: None,
        };
        gop::visit(&mut session, &self.source, &self.presented, sorted, each)
    }

    /// Checks that a sequence parameter set within the stream agrees with the first set.
    fn check_sequence(&self, unit: &[u8], offset: u64, frame: u64) -> Result<(), Refusal> {
        let Some(sequence) = Sequence::read(unit) else {
            return Err(self
                .source
                .damaged(offset, "the sequence parameter set has an unknown layout")
                .into());
        };
        if (sequence.width, sequence.height) != self.size() {
            return Err(self
                .changed_size(frame, u64::from(sequence.width), u64::from(sequence.height))
                .into());
        }
        if sequence.is_too_large() {
            return Err(self
                .source
                .damaged(
                    offset,
                    "larger frames or more reference frames than any level allows",
                )
                .into());
        }
        match sequence.foreign() {
            Some(tool) => Err(Refusal::Tool(tool.to_owned())),
            None => Ok(()),
        }
    }

    fn convert(
        &self,
        picture: Decoded,
        frame: u64,
        colours: Colours,
    ) -> Result<Picture, VideoError> {
        let (width, height) = self.size();
        if (picture.width as u64, picture.height as u64) != (u64::from(width), u64::from(height)) {
            return Err(self.changed_size(frame, picture.width as u64, picture.height as u64));
        }
        let pixels = width as usize * height as usize;
        let is_whole = picture.luma.len() == pixels
            && picture.chroma.iter().all(|plane| plane.len() == pixels / 4);
        if !is_whole {
            return Err(VideoError::Decoder {
                path: self.source.path().to_owned(),
                decoder: DECODER,
                frame,
                problem: format!("the planes do not match {width}×{height} pixels"),
            });
        }
        let samples = match colours {
            Colours::Luma => picture.luma,
            Colours::Rgb => {
                let [blue, red] = &picture.chroma;
                let planes = Planes::new(width, height, &picture.luma, Some([blue, red]), [1, 1]);
                let rgb = planes.to_rgb(self.coding);
                rgb.map_err(|problem| problem.at(self.source.path()))?
            }
        };
        Ok(Picture::Pixels {
            width,
            height,
            samples,
        })
    }

    fn changed_size(&self, frame: u64, width: u64, height: u64) -> VideoError {
        let (expected_width, expected_height) = self.size();
        VideoError::ChangedSize {
            path: self.source.path().to_owned(),
            frame,
            found: format!("{width}×{height}"),
            expected: format!("{expected_width}×{expected_height}"),
        }
    }
}

/// Visit of a clip, with its decoder.
struct Session<'a> {
    clip: &'a H264Clip,
    colours: Colours,
    /// Decoder of the samples; `None` before the first sample and after a reset.
    decoder: Option<Decoder>,
}

impl SampleDecoder for Session<'_> {
    type Refusal = Refusal;

    fn is_key(&self, sample: usize) -> Result<bool, VideoError> {
        let H264Clip {
            samples,
            settings,
            source,
            ..
        } = self.clip;
        let Sample {
            offset,
            size,
            is_sync,
            ..
        } = samples[sample];
        Ok(is_sync && settings.is_key(source, offset, size)?)
    }

    fn restart(&mut self) {
        self.decoder = None;
    }

    fn decode(&mut self, sample: usize, towards: Wanted) -> Result<Option<Picture>, Refusal> {
        let H264Clip {
            source,
            settings,
            samples,
            ..
        } = self.clip;
        let Sample { offset, size, .. } = samples[sample];
        let refusal = |error: DecodeError| match error {
            DecodeError::Unsupported(tool) => Refusal::Tool(format!("with {tool}")),
            other => {
                let problem = format!("before frame {}: {other}", towards.frame);
                Refusal::Video(source.damaged(offset, problem))
            }
        };
        let decoder = match &mut self.decoder {
            Some(decoder) => decoder,
            none => {
                let decoder = none.insert(Decoder::new());
                decoder.decode(&settings.parameters).map_err(refusal)?;
                decoder
            }
        };
        let bytes = source.read(
            offset,
            u64::from(size),
            "bytes of a packet",
            limits::PACKET_BYTES,
        )?;
        let mut stream = Vec::with_capacity(bytes.len() + 64);
        for (at, unit) in settings.units(source, &bytes, offset)? {
            if UnitKind::of(unit[0]) == UnitKind::Sequence {
                self.clip.check_sequence(unit, at, towards.frame)?;
            }
            push_unit(&mut stream, unit);
        }
        let picture = decoder.decode(&stream).map_err(refusal)?;
        if sample != towards.sample {
            return Ok(None);
        }
        let Some(picture) = picture else {
            let problem = format!("no complete picture for frame {}", towards.frame);
            return Err(source.damaged(offset, problem).into());
        };
        let decoded = Decoded {
            width: picture.width,
            height: picture.height,
            luma: picture.y,
            chroma: [picture.u, picture.v],
        };
        Ok(Some(self.clip.convert(
            decoded,
            towards.frame,
            self.colours,
        )?))
    }
}

/// First sequence parameter set in the samples of a stream whose container states none.
fn first_sequence(
    source: &Source,
    settings: &Settings,
    track: &Track,
) -> Result<Sequence, VideoError> {
    let first = track.samples[0];
    let bytes = source.read(
        first.offset,
        u64::from(first.size),
        "bytes of a packet",
        limits::PACKET_BYTES,
    )?;
    let units = settings.units(source, &bytes, first.offset)?;
    let sequence = units
        .iter()
        .find(|(_, unit)| UnitKind::of(unit[0]) == UnitKind::Sequence);
    sequence
        .and_then(|(_, unit)| Sequence::read(unit))
        .ok_or_else(|| {
            source.damaged(
                first.offset,
                "the stream does not state the size of its frames",
            )
        })
}
