//! A clip, whatever container and codec it has.

use std::cell::Cell;
use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::avi::{self, Avi};
use crate::clip::{Colours, Picture, VideoInfo};
use crate::error::{VideoError, VisitError};
use crate::ffmpeg::{ForeignClip, Known};
use crate::h264::{self, H264Clip, Refusal};
use crate::matroska;
use crate::mp4::{self, Coding, Found, Track};
use crate::packets::{self, JpegClip, Packet};
use crate::source::Source;

/// Programs that decode what is not decoded here.
///
/// Complete: a codec is decoded in this process, in a confined child, or by a program of others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Decoders {
    /// The program ffmpeg, for everything that is not named elsewhere.
    pub ffmpeg: Option<PathBuf>,
    /// A program and its arguments that runs `taceva_video::av1::serve` between its standard input and output, for AV1.
    pub av1: Option<Vec<OsString>>,
}

/// A clip whose frames are read by their place in the order of presentation.
///
/// ```no_run
/// use taceva_video::{Colours, Decoders, Video};
/// let clip = Video::open("press.mp4".as_ref(), &Decoders::default())?;
/// println!("{} frames of {}", clip.info().frames, clip.info().codec);
/// clip.visit(&[0, 10], Colours::Luma, &mut |index, picture| {
///     println!("{index}: {picture:?}");
///     Ok::<(), std::convert::Infallible>(())
/// })?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Video {
    info: VideoInfo,
    path: PathBuf,
    frames: Frames,
}

/// How frames are come by.
#[derive(Debug)]
enum Frames {
    Jpeg(JpegClip),
    H264 {
        clip: Box<H264Clip>,
        /// ffmpeg, for tools of the codec that only show once a frame is decoded.
        else_by: Option<PathBuf>,
    },
    Foreign(ForeignClip),
}

impl Video {
    /// Reads what the container says of the clip at `path`, and finds who decodes it.
    ///
    /// # Errors
    /// [`VideoError`]: what is wrong with the file, or [`VideoError::NoDecoder`] if nothing at hand decodes its codec.
    pub fn open(path: &Path, decoders: &Decoders) -> Result<Video, VideoError> {
        let source = Source::open(path)?;
        let mut start = [0; 16];
        let known = usize::try_from(source.length()).map_or(16, |length| length.min(16));
        source.read_into(0, &mut start[..known])?;
        let start = &start[..known];
        if avi::is_avi(start) {
            return Video::open_avi(source, decoders);
        }
        if mp4::is_mp4(start) {
            return Video::open_mp4(source, decoders);
        }
        if matroska::is_matroska(start) {
            let known = Known {
                container: Some("Matroska"),
                codec: matroska::codec(&source)?,
                why: "",
            };
            return Video::open_foreign(path, known, decoders);
        }
        match decoders.ffmpeg {
            Some(_) => {
                let known = Known {
                    container: None,
                    codec: None,
                    why: "",
                };
                Video::open_foreign(path, known, decoders)
            }
            None => Err(source.damaged(
                0,
                "no container of video that is read without ffmpeg begins here, expected AVI, MP4, QuickTime or Matroska",
            )),
        }
    }

    /// A clip that is decoded by ffmpeg, if there is one.
    fn open_foreign(path: &Path, known: Known, decoders: &Decoders) -> Result<Video, VideoError> {
        let Some(program) = &decoders.ffmpeg else {
            return Err(known.no_decoder(path));
        };
        let (info, clip) = ForeignClip::open(path, program, &known)?;
        Ok(Video {
            info,
            path: path.to_owned(),
            frames: Frames::Foreign(clip),
        })
    }

    fn open_avi(source: Source, decoders: &Decoders) -> Result<Video, VideoError> {
        let clip = Avi::read(&source)?;
        let foreign = |codec: String, why| {
            let known = Known {
                container: Some("AVI"),
                codec: Some(codec),
                why,
            };
            Video::open_foreign(source.path(), known, decoders)
        };
        if !clip.is_motion_jpeg() {
            return foreign(clip.codec(), "");
        }
        if let Some(&first) = clip.packets.first() {
            let (_, header) = packets::read_packet(&source, first)?;
            if header.width == clip.stream.width && header.height * 2 == clip.stream.height {
                return foreign("MJPEG".to_owned(), "of two fields a frame");
            }
        }
        let about = About {
            container: "AVI",
            codec: "MJPEG".to_owned(),
            size: (clip.stream.width, clip.stream.height),
            times_s: clip.times_s(),
        };
        Video::of_jpegs(source, about, clip.packets)
    }

    fn open_mp4(source: Source, decoders: &Decoders) -> Result<Video, VideoError> {
        let track = match mp4::read(&source)? {
            Found::Track(track) => track,
            Found::Elsewhere { codec, why } => {
                let known = Known {
                    container: Some("MP4"),
                    codec: Some(codec),
                    why,
                };
                return Video::open_foreign(source.path(), known, decoders);
            }
        };
        let about = About {
            container: "MP4",
            codec: track.entry.coding.name(),
            size: (track.entry.width, track.entry.height),
            times_s: Some(track.times_s.clone()),
        };
        match &track.entry.coding {
            Coding::Jpeg => {
                let packets = packets_of(&track);
                Video::of_jpegs(source, about, packets)
            }
            Coding::H264(settings, offset) => {
                let (clip, foreign) = H264Clip::open(source, &track, settings, *offset)?;
                let sequence = &clip.sequence;
                if let Some(why) = foreign {
                    let known = Known {
                        container: Some("MP4"),
                        codec: Some(sequence.codec()),
                        why,
                    };
                    return Video::open_foreign(clip.source().path(), known, decoders);
                }
                let (width, height) = clip.size();
                let info = VideoInfo {
                    container: about.container.to_owned(),
                    codec: sequence.codec(),
                    pixel_format: sequence.pixel_format(),
                    width,
                    height,
                    frames: track.presented.len() as u64,
                    times_s: about.times_s,
                    lossy: Some(true),
                    decoder: Some(h264::DECODER.to_owned()),
                };
                Ok(Video {
                    path: clip.source().path().to_owned(),
                    info,
                    frames: Frames::H264 {
                        clip: Box::new(clip),
                        else_by: decoders.ffmpeg.clone(),
                    },
                })
            }
            other @ (Coding::Av1(_) | Coding::Other(_)) => {
                let known = Known {
                    container: Some("MP4"),
                    codec: Some(other.name()),
                    why: "",
                };
                Video::open_foreign(source.path(), known, decoders)
            }
        }
    }

    /// A clip whose packets are JPEG files.
    fn of_jpegs(source: Source, about: About, packets: Vec<Packet>) -> Result<Video, VideoError> {
        let Some(&first) = packets.first() else {
            return Err(source.damaged(source.length(), "the clip has no frame"));
        };
        let (_, header) = packets::read_packet(&source, first)?;
        let (width, height) = about.size;
        let info = VideoInfo {
            container: about.container.to_owned(),
            codec: about.codec,
            pixel_format: header.pixel_format.to_owned(),
            width,
            height,
            frames: packets.len() as u64,
            times_s: about.times_s,
            lossy: Some(true),
            decoder: None,
        };
        Ok(Video {
            path: source.path().to_owned(),
            info,
            frames: Frames::Jpeg(JpegClip {
                source,
                packets,
                width,
                height,
            }),
        })
    }

    /// What is known of it.
    pub fn info(&self) -> &VideoInfo {
        &self.info
    }

    /// Shows the frames of `sorted`, rising numbers from 0 in the order of presentation, to `each`, which gets every number once.
    ///
    /// Nothing but what lies between the key frame before a frame and that frame is decoded. One picture is in memory at a time, and those
    /// that the codec keeps to decode the next. Threads may share the clip, each with a visit of its own.
    ///
    /// # Errors
    /// [`VisitError::Video`] for what cannot be read, [`VisitError::Caller`] for what `each` returned.
    pub fn visit<E>(
        &self,
        sorted: &[u64],
        colours: Colours,
        each: &mut dyn FnMut(u64, Picture) -> Result<(), E>,
    ) -> Result<(), VisitError<E>> {
        self.check(sorted)?;
        let mut refused = None;
        let shown = Cell::new(0);
        let mut show = |index, picture| {
            shown.set(shown.get() + 1);
            match each(index, picture) {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    refused = Some(error);
                    ControlFlow::Break(())
                }
            }
        };
        match &self.frames {
            Frames::Jpeg(clip) => clip.visit(sorted, &mut show)?,
            Frames::H264 { clip, else_by } => match clip.visit(sorted, colours, &mut show) {
                Ok(()) => {}
                Err(Refusal::Video(error)) => return Err(error.into()),
                Err(Refusal::Tool(tool)) => {
                    let rest = &sorted[shown.get()..];
                    self.go_on(else_by.as_deref(), tool, rest, colours, &mut show)?;
                }
            },
            Frames::Foreign(clip) => clip.visit(sorted, colours, &mut show)?,
        }
        refused.map_or(Ok(()), |error| Err(VisitError::Caller(error)))
    }

    /// Shows the frames of `rest` by ffmpeg, since the stream needs a `tool` that the decoder of this process does not have.
    fn go_on(
        &self,
        program: Option<&Path>,
        tool: &'static str,
        rest: &[u64],
        colours: Colours,
        show: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<(), VideoError> {
        let known = Known {
            container: Some("MP4"),
            codec: Some(format!("{} with", self.info.codec)),
            why: tool,
        };
        let Some(program) = program else {
            return Err(known.no_decoder(&self.path));
        };
        let (info, clip) = ForeignClip::open(&self.path, program, &known)?;
        let (found, expected) = (
            (info.width, info.height, info.frames),
            (self.info.width, self.info.height, self.info.frames),
        );
        if found != expected {
            return Err(VideoError::Process {
                path: self.path.clone(),
                program: program.display().to_string(),
                problem: format!(
                    "finds {} frames of {}×{}, the container says {} of {}×{}",
                    found.2, found.0, found.1, expected.2, expected.0, expected.1
                ),
            });
        }
        clip.visit(rest, colours, show)
    }

    /// Whether there are such frames, in such an order.
    fn check(&self, sorted: &[u64]) -> Result<(), VideoError> {
        if let Some(pair) = sorted.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(VideoError::Unsorted {
                path: self.path.clone(),
                index: pair[1],
                after: pair[0],
            });
        }
        match sorted.last() {
            Some(&index) if index >= self.info.frames => Err(VideoError::NoFrame {
                path: self.path.clone(),
                index,
                frames: self.info.frames,
            }),
            _ => Ok(()),
        }
    }
}

/// What a container says of its clip.
struct About {
    container: &'static str,
    codec: String,
    size: (u32, u32),
    times_s: Option<Vec<f64>>,
}

/// Where the frames of a track lie in the order of presentation.
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
