//! A clip, whatever container and codec it has.

use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::avi::{self, Avi};
use crate::clip::{Colours, Picture, VideoInfo};
use crate::error::{VideoError, VisitError};
use crate::packets::{self, JpegClip};
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
        if avi::is_avi(&start[..known]) {
            return Video::open_avi(source);
        }
        let _ = decoders;
        Err(source.damaged(0, "no video container begins here, expected AVI"))
    }

    fn open_avi(source: Source) -> Result<Video, VideoError> {
        let clip = Avi::read(&source)?;
        let (info, clip) = motion_jpeg(source, &clip)?;
        Ok(Video {
            path: clip.source.path().to_owned(),
            info,
            frames: Frames::Jpeg(clip),
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
        let _ = colours;
        match &self.frames {
            Frames::Jpeg(clip) => clip.visit(sorted, &mut show)?,
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

/// Motion JPEG in an AVI file.
fn motion_jpeg(source: Source, clip: &Avi) -> Result<(VideoInfo, JpegClip), VideoError> {
    let Some(&first) = clip.packets.first() else {
        return Err(source.damaged(source.length(), "the clip has no frame"));
    };
    let (_, header) = packets::read_packet(&source, first)?;
    let info = VideoInfo {
        container: "AVI".to_owned(),
        codec: "MJPEG".to_owned(),
        pixel_format: header.pixel_format.to_owned(),
        width: clip.stream.width,
        height: clip.stream.height,
        frames: clip.packets.len() as u64,
        times_s: clip.times_s(),
        lossy: Some(true),
        decoder: None,
    };
    let clip = JpegClip {
        source,
        packets: clip.packets.clone(),
        width: info.width,
        height: info.height,
    };
    Ok((info, clip))
}
