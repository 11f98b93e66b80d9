//! Parent of the child process that decodes AV1.

use std::ffi::OsString;
use std::io::Write;
use std::ops::ControlFlow;
use std::process::{ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

use super::wire::{Answer, Greeting, Unit, Yuv, plane_bytes};
use crate::clip::{Colours, Picture};
use crate::colour::{Planes, YuvCoding};
use crate::error::VideoError;
use crate::gop::{self, SampleDecoder, Wanted};
use crate::limits;
use crate::mp4::{Sample, Track};
use crate::process::{Piece, Running};
use crate::source::Source;

/// AV1 clip, decoded by a child process.
#[derive(Debug)]
pub(crate) struct Av1Clip {
    source: Source,
    samples: Vec<Sample>,
    presented: Vec<u32>,
    /// AV1 sequence header from the container, which is sent to the child before the first sample.
    settings: Vec<u8>,
    size: Greeting,
    coding: YuvCoding,
    program: Vec<OsString>,
}

/// Name and version of the decoder library.
pub(crate) const DECODER: &str = "rav1d 1.1";

impl Av1Clip {
    /// Pixel format stated by the settings `av1C`; `None` if the child cannot decode it.
    pub(crate) fn pixel_format(settings: &[u8]) -> Option<&'static str> {
        let &[version, _, flags, ..] = settings else {
            return None;
        };
        let (is_deep, is_gray, sampling) = (flags & 0x60 != 0, flags & 0x10 != 0, flags & 0x0c);
        match (version, is_deep, is_gray, sampling) {
            (0x81, false, true, _) => Some("gray"),
            (0x81, false, false, 0x0c) => Some("yuv420p"),
            _ => None,
        }
    }

    /// Opens the AV1 clip of `track`, to be decoded by `program`. `settings` is the content of the MP4 box `av1C`.
    pub(crate) fn open(
        source: Source,
        track: Track,
        settings: &[u8],
        program: &[OsString],
    ) -> Result<Av1Clip, VideoError> {
        let (width, height) = (track.entry.width, track.entry.height);
        let bytes = plane_bytes(width, height, false);
        if bytes > limits::FRAME_BYTES {
            return Err(VideoError::TooLarge {
                path: source.path().to_owned(),
                what: "bytes of a decoded frame",
                found: bytes,
                limit: limits::FRAME_BYTES,
            });
        }
        let colour = track.entry.colour;
        Ok(Av1Clip {
            source,
            samples: track.samples,
            presented: track.presented,
            // Skips four bytes that repeat the sequence header.
            settings: settings.get(4..).unwrap_or_default().to_vec(),
            size: Greeting { width, height },
            coding: YuvCoding {
                matrix: colour.map(|colour| colour.matrix),
                is_full_range: colour.is_some_and(|colour| colour.is_full_range),
            },
            program: program.to_vec(),
        })
    }

    /// Calls `each` with the frames whose indices are in `sorted`.
    pub(crate) fn visit(
        &self,
        sorted: &[u64],
        colours: Colours,
        each: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<(), VideoError> {
        let mut session = Session::start(self, colours)?;
        gop::visit(&mut session, &self.source, &self.presented, sorted, each)
    }

    fn failed(&self, problem: impl Into<String>) -> VideoError {
        let program = self.program.first().map_or_else(String::new, |program| {
            program.to_string_lossy().into_owned()
        });
        VideoError::Process {
            path: self.source.path().to_owned(),
            program,
            problem: problem.into(),
        }
    }

    fn convert(&self, yuv: Yuv, frame: u64, colours: Colours) -> Result<Picture, VideoError> {
        let Greeting { width, height } = self.size;
        if (yuv.width, yuv.height) != (width, height) {
            return Err(VideoError::ChangedSize {
                path: self.source.path().to_owned(),
                frame,
                found: format!("{}×{}", yuv.width, yuv.height),
                expected: format!("{width}×{height}"),
            });
        }
        let mut planes = yuv.planes;
        let pixels = width as usize * height as usize;
        let samples = match colours {
            Colours::Luma => {
                planes.truncate(pixels);
                planes
            }
            Colours::Rgb => {
                let (luma, chroma) = planes.split_at(pixels);
                let (blue, red) = chroma.split_at(chroma.len() / 2);
                let chroma = (!yuv.is_gray).then_some([blue, red]);
                // 2 means unspecified.
                let is_named = yuv.matrix != 2;
                let coding = YuvCoding {
                    matrix: if is_named {
                        Some(yuv.matrix)
                    } else {
                        self.coding.matrix
                    },
                    is_full_range: yuv.is_full_range,
                };
                let planes = Planes::new(width, height, luma, chroma, [1, 1]);
                planes
                    .to_rgb(coding)
                    .map_err(|problem| problem.at(self.source.path()))?
            }
        };
        Ok(Picture::Pixels {
            width,
            height,
            samples,
        })
    }
}

/// State of one visit of a clip, with the running child process.
struct Session<'a> {
    clip: &'a Av1Clip,
    colours: Colours,
    running: Running,
    to: SyncSender<Unit>,
    is_restart: bool,
    /// Last line that the child wrote to standard error.
    said: String,
}

impl<'a> Session<'a> {
    fn start(clip: &'a Av1Clip, colours: Colours) -> Result<Session<'a>, VideoError> {
        let Some((program, arguments)) = clip.program.split_first() else {
            return Err(clip.failed("no program is set for the AV1 decoder process"));
        };
        let mut command = Command::new(program);
        command.args(arguments).stdin(Stdio::piped());
        // The child cannot read the files of a backtrace.
        command.env("RUST_BACKTRACE", "0");
        let size = clip.size;
        let take = Box::new(move |from: &mut dyn std::io::Read| Answer::take(from, size));
        let not_started = |error| clip.failed(format!("does not start: {error}"));
        let mut running = Running::start(command, Some(take)).map_err(not_started)?;
        let Some(input) = running.child().stdin.take() else {
            return Err(clip.failed("has no standard input"));
        };
        let (to, units) = sync_channel(1);
        // A separate thread, because a child that stops reading would block the writer.
        let writer = thread::Builder::new().spawn(move || write_units(input, size, &units));
        writer.map_err(not_started)?;
        Ok(Session {
            clip,
            colours,
            running,
            to,
            is_restart: true,
            said: String::new(),
        })
    }

    /// Sends the packet `unit` of a frame. Returns the answer of the child.
    fn ask(&mut self, unit: Unit, frame: u64) -> Result<Answer, VideoError> {
        let is_sent = self.to.send(unit).is_ok();
        loop {
            match self.running.next() {
                Ok(Piece::Line(line)) if !line.is_empty() => self.said = line,
                Ok(Piece::Line(_)) => {}
                Ok(Piece::Block(block)) if is_sent => {
                    let answer = Answer::parse(block);
                    return answer.ok_or_else(|| {
                        self.clip
                            .failed("its answer does not follow the protocol of the AV1 decoder")
                    });
                }
                Ok(Piece::Block(_)) => {}
                Err(ended) => {
                    let said = taceva_core::shown(&self.said);
                    let problem =
                        format!("the AV1 decoder process {ended} before frame {frame}: {said}");
                    return Err(self.clip.failed(problem.trim_end_matches(": ")));
                }
            }
        }
    }
}

fn write_units(mut input: ChildStdin, size: Greeting, units: &Receiver<Unit>) {
    if size.write(&mut input).is_err() {
        return;
    }
    while let Ok(unit) = units.recv() {
        if unit.write(&mut input).and_then(|()| input.flush()).is_err() {
            return;
        }
    }
}

impl SampleDecoder for Session<'_> {
    type Refusal = VideoError;

    fn is_key(&self, sample: usize) -> Result<bool, VideoError> {
        Ok(self.clip.samples[sample].is_sync)
    }

    fn restart(&mut self) {
        self.is_restart = true;
    }

    fn decode(&mut self, sample: usize, towards: Wanted) -> Result<Option<Picture>, VideoError> {
        let Sample { offset, size, .. } = self.clip.samples[sample];
        let source = &self.clip.source;
        let sample_bytes = source.read(
            offset,
            u64::from(size),
            "bytes of a packet",
            limits::PACKET_BYTES,
        )?;
        let is_restart = std::mem::take(&mut self.is_restart);
        let bytes = match is_restart {
            true => [self.clip.settings.as_slice(), &sample_bytes].concat(),
            false => sample_bytes,
        };
        let is_wanted = sample == towards.sample;
        let unit = Unit {
            is_restart,
            is_wanted,
            bytes,
        };
        match self.ask(unit, towards.frame)? {
            Answer::Picture(yuv) => {
                Ok(Some(self.clip.convert(yuv, towards.frame, self.colours)?))
            }
            Answer::Refused(problem) => Err(VideoError::Decoder {
                path: source.path().to_owned(),
                decoder: DECODER,
                frame: towards.frame,
                problem: taceva_core::shown(&problem).to_string(),
            }),
            Answer::Decoded { .. } if is_wanted => {
                let problem = format!("no picture for frame {}", towards.frame);
                Err(source.damaged(offset, problem))
            }
            Answer::Decoded { .. } => Ok(None),
        }
    }
}
