//! A clip, whatever container and codec it has.

use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::avi::{self, Avi};
use crate::clip::{Colours, Picture, VideoInfo};
use crate::error::{VideoError, VisitError};
use crate::h264::{self, H264Clip, Refusal};
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
    H264(Box<H264Clip>),
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
            return Video::open_avi(source);
        }
        if mp4::is_mp4(start) {
            return Video::open_mp4(source, decoders);
        }
        Err(source.damaged(0, "no video container begins here, expected AVI or MP4"))
    }

    fn open_avi(source: Source) -> Result<Video, VideoError> {
        let clip = Avi::read(&source)?;
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
                return Err(no_decoder(source.path(), &codec, why));
            }
        };
        let _ = decoders;
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
                    return Err(no_decoder(clip.source().path(), &sequence.codec(), why));
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
                    frames: Frames::H264(Box::new(clip)),
                })
            }
            other => Err(no_decoder(source.path(), &other.name(), "")),
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
        let mut show = |index, picture| match each(index, picture) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                refused = Some(error);
                ControlFlow::Break(())
            }
        };
        match &self.frames {
            Frames::Jpeg(clip) => clip.visit(sorted, &mut show)?,
            Frames::H264(clip) => match clip.visit(sorted, colours, &mut show) {
                Ok(()) => {}
                Err(Refusal::Video(error)) => return Err(error.into()),
                Err(Refusal::Tool { tool, .. }) => {
                    return Err(no_decoder(&self.path, &self.info.codec, tool).into());
                }
            },
        }
        refused.map_or(Ok(()), |error| Err(VisitError::Caller(error)))
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

/// That nothing at hand decodes `codec`, with what is the matter with it.
fn no_decoder(path: &Path, codec: &str, why: &str) -> VideoError {
    VideoError::NoDecoder {
        path: path.to_owned(),
        codec: [codec, why].join(" ").trim().to_owned(),
        remedy: "install ffmpeg (`pip install imageio-ffmpeg` brings one), or name it by `--ffmpeg PROGRAM` or TACEVA_FFMPEG".to_owned(),
    }
}
