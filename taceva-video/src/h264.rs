//! H.264 of 8 bits and 4:2:0 in MP4: decoded sample by sample, from the key frame before what is wanted.
//!
//! The order of presentation is that of the container, so that no frame is kept but those that wait for an earlier one.

mod bits;
mod parameters;
mod units;

use std::ops::ControlFlow;

use rusty_h264_decoder::{DecodeError, Decoder};

use crate::clip::{Colours, Picture};
use crate::colour::{Planes, YuvCoding};
use crate::error::VideoError;
use crate::limits;
use crate::mp4::{Sample, Track};
use crate::reorder::Reorder;
use crate::source::Source;

use units::{Settings, UnitKind, push_unit};

pub(crate) use parameters::Sequence;

/// The name and version of the library that decodes.
pub(crate) const DECODER: &str = "rusty_h264-decoder 0.17";

/// A clip of H.264 that is decoded here.
#[derive(Debug)]
pub(crate) struct H264Clip {
    source: Source,
    samples: Vec<Sample>,
    /// Numbers of samples in the order of presentation.
    presented: Vec<u32>,
    settings: Settings,
    pub(crate) sequence: Sequence,
    coding: YuvCoding,
}

/// Why a frame was not decoded.
pub(crate) enum Refusal {
    Video(VideoError),
    /// The stream needs a tool of the codec that the decoder does not have.
    Tool(&'static str),
}

/// A picture as the decoder gives it: rows without padding, chroma half as wide and high.
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
    /// The clip of a track, with why others must decode it, if so.
    pub(crate) fn open(
        source: Source,
        track: &Track,
        settings: &[u8],
        offset: u64,
    ) -> Result<(H264Clip, Option<&'static str>), VideoError> {
        let settings = Settings::read(&source, settings, offset)?;
        let sequence = match &settings.sequence {
            Some(sequence) => sequence.clone(),
            None => first_sequence(&source, &settings, track)?,
        };
        if sequence.is_too_large() {
            return Err(VideoError::TooLarge {
                path: source.path().to_owned(),
                what: "pixels of a frame of H.264",
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
            samples: track.samples.clone(),
            presented: track.presented.clone(),
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

    /// Shows the frames of `sorted`, which are there.
    pub(crate) fn visit(
        &self,
        sorted: &[u64],
        colours: Colours,
        each: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        // What is wanted in the order of decoding: sample, frame.
        let place =
            |frame: &u64| self.presented[usize::try_from(*frame).unwrap_or(usize::MAX)] as usize;
        let mut wanted: Vec<(usize, u64)> =
            sorted.iter().map(|frame| (place(frame), *frame)).collect();
        wanted.sort_unstable();
        let mut reorder = Reorder::new(&self.source, sorted);
        let mut decoder: Option<Decoder> = None;
        let mut next = 0;
        for (sample, frame) in wanted {
            if let Some(key) = self.key_between(next, sample)? {
                next = key;
                decoder = None;
            }
            let decoder = match &mut decoder {
                Some(decoder) => decoder,
                none => none.insert(self.start(frame)?),
            };
            while next <= sample {
                let picture = self.decode(decoder, next, frame)?;
                if next == sample {
                    let picture = picture.ok_or_else(|| {
                        let offset = self.samples[sample].offset;
                        self.source
                            .damaged(offset, format!("no whole picture for frame {frame}"))
                    })?;
                    let picture = self.convert(picture, frame, colours)?;
                    if reorder.add(frame, picture, each)?.is_break() {
                        return Ok(());
                    }
                }
                next += 1;
            }
        }
        Ok(())
    }

    /// The last sample from `from` to `to` at which decoding can begin; nothing where it has to go on as it is.
    fn key_between(&self, from: usize, to: usize) -> Result<Option<usize>, VideoError> {
        for at in (from..=to).rev() {
            let sample = &self.samples[at];
            if sample.is_sync
                && self
                    .settings
                    .is_key(&self.source, sample.offset, sample.size)?
            {
                return Ok(Some(at));
            }
        }
        Ok(None)
    }

    /// A decoder that knows the parameters of the stream.
    fn start(&self, frame: u64) -> Result<Decoder, Refusal> {
        let mut decoder = Decoder::new();
        match decoder.decode(&self.settings.parameters) {
            Ok(_) => Ok(decoder),
            Err(error) => Err(self.refusal(&error, frame, 0)),
        }
    }

    /// The picture of a sample, if it completes one. `frame` is what is on the way to.
    fn decode(
        &self,
        decoder: &mut Decoder,
        sample: usize,
        frame: u64,
    ) -> Result<Option<Decoded>, Refusal> {
        let Sample { offset, size, .. } = self.samples[sample];
        let bytes = self.source.read(
            offset,
            u64::from(size),
            "bytes of a packet",
            limits::PACKET_BYTES,
        )?;
        let mut stream = Vec::with_capacity(bytes.len() + 64);
        for (at, unit) in self.settings.units(&self.source, &bytes, offset)? {
            if UnitKind::of(unit[0]) == UnitKind::Sequence {
                self.check_sequence(unit, at, frame)?;
            }
            push_unit(&mut stream, unit);
        }
        let picture = decoder.decode(&stream);
        let picture = picture.map_err(|error| self.refusal(&error, frame, offset))?;
        Ok(picture.map(|picture| Decoded {
            width: picture.width,
            height: picture.height,
            luma: picture.y,
            chroma: [picture.u, picture.v],
        }))
    }

    /// Whether a parameter set within the stream says what those at its beginning do.
    fn check_sequence(&self, unit: &[u8], offset: u64, frame: u64) -> Result<(), Refusal> {
        let Some(sequence) = Sequence::read(unit) else {
            return Err(self
                .source
                .damaged(offset, "a sequence of no known layout")
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
                .damaged(offset, "more frames to be kept than any level admits")
                .into());
        }
        match sequence.foreign() {
            Some(tool) => Err(Refusal::Tool(tool)),
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
        let samples = match colours {
            Colours::Luma => picture.luma,
            Colours::Rgb => {
                let [blue, red] = &picture.chroma;
                let planes = Planes::new(width, height, &picture.luma, Some([blue, red]), (1, 1));
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

    fn refusal(&self, error: &DecodeError, frame: u64, offset: u64) -> Refusal {
        match error {
            DecodeError::Unsupported(tool) => Refusal::Tool(tool),
            other => Refusal::Video(
                self.source
                    .damaged(offset, format!("on the way to frame {frame}: {other}")),
            ),
        }
    }
}

/// The first sequence parameter set of a stream whose container has none.
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
                "the stream does not say how large its frames are",
            )
        })
}
