//! Clip of any supported container and codec.

mod decoder_choice;

use std::cell::Cell;
use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::av1::Av1Clip;
use crate::clip::{Colours, Picture, VideoInfo};
use crate::error::{VideoError, VisitError};
use crate::ffmpeg::{ForeignClip, Known};
use crate::h264::{H264Clip, Refusal};
use crate::packets::JpegClip;

/// External decoders for codecs that this process does not decode.
///
/// The struct gets no further field. A codec is decoded in this process, in a confined child process, or by ffmpeg.
///
/// ```
/// use std::path::PathBuf;
/// use taceva_video::Decoders;
/// // ffmpeg from a variable or from the path. This program is the child if it has such a command.
/// let named = std::env::var_os("TACEVA_FFMPEG").map(PathBuf::from);
/// let this = std::env::current_exe()?;
/// let decoders = Decoders {
///     ffmpeg: Some(named.unwrap_or_else(|| "ffmpeg".into())),
///     av1: Some(vec![this.into(), "decode-av1".into()]),
/// };
/// assert!(decoders != Decoders::default());
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Decoders {
    /// Path of the program ffmpeg, which decodes all other codecs and containers; `None` if not available.
    pub ffmpeg: Option<PathBuf>,
    /// Program for AV1 and its arguments; `None` if not available. The program must run `taceva_video::av1::serve` between standard input and output.
    pub av1: Option<Vec<OsString>>,
}

/// Clip whose frames are read by their index in presentation order.
///
/// ```
/// use taceva_video::{Colours, Decoders, Video};
/// # let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../tests/recordings/mp4-h264-baseline/clip.mp4");
/// let clip = Video::open(file.as_ref(), &Decoders::default())?;
/// let mut shown = Vec::new();
/// clip.visit(&[3, 10], Colours::Luma, &mut |index, picture| {
///     shown.push((index, picture.to_string()));
///     Ok::<(), std::convert::Infallible>(())
/// })?;
/// let words = "a picture of 64×48 pixels of 8 bits";
/// assert_eq!(shown, [(3, words.to_owned()), (10, words.to_owned())]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Video {
    info: VideoInfo,
    path: PathBuf,
    frames: Frames,
}

/// Source of the frames.
#[derive(Debug)]
pub(crate) enum Frames {
    Jpeg(JpegClip),
    H264 {
        clip: Box<H264Clip>,
        /// Path of ffmpeg, for streams with an unsupported codec feature that is detected only when a frame is decoded; `None` if not available.
        else_by: Option<PathBuf>,
    },
    Av1(Box<Av1Clip>),
    Foreign(ForeignClip),
}

impl Video {
    /// Opens the clip at `path`. Parses its container and chooses a decoder.
    ///
    /// # Errors
    /// [`VideoError`] for a fault of the file. [`VideoError::NoDecoder`] if no available decoder supports the codec.
    pub fn open(path: &Path, decoders: &Decoders) -> Result<Video, VideoError> {
        let (info, frames) = decoder_choice::open(path, decoders)?;
        Ok(Video {
            info,
            path: path.to_owned(),
            frames,
        })
    }

    /// Properties of the clip.
    pub fn info(&self) -> &VideoInfo {
        &self.info
    }

    /// Calls `each` with the frames in `sorted` and their indices. The indices count from 0 in presentation order and must be strictly ascending.
    ///
    /// Decodes only from the key frame before a frame up to that frame. Keeps one picture in memory, and the pictures that the codec needs later.
    /// Threads may share the clip, each with a separate visit.
    ///
    /// # Errors
    /// [`VisitError::Video`] if a frame cannot be read. [`VisitError::Caller`] for an error of `each`.
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
                    self.go_on(else_by.as_deref(), &tool, rest, colours, &mut show)?;
                }
            },
            Frames::Av1(clip) => clip.visit(sorted, colours, &mut show)?,
            Frames::Foreign(clip) => clip.visit(sorted, colours, &mut show)?,
        }
        refused.map_or(Ok(()), |error| Err(VisitError::Caller(error)))
    }

    /// Visits the frames of `rest` with ffmpeg, because the stream needs the codec feature `tool`, which this process does not support.
    fn go_on(
        &self,
        program: Option<&Path>,
        tool: &str,
        rest: &[u64],
        colours: Colours,
        show: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<(), VideoError> {
        let known = Known::new("MP4", Some(self.info.codec.clone()), tool);
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
                    "found {} frames of {}×{}, but the container states {} of {}×{}",
                    found.2, found.0, found.1, expected.2, expected.0, expected.1
                ),
            });
        }
        clip.visit(rest, colours, show)
    }

    /// Checks that the requested frames exist and are strictly ascending.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_may_share_a_clip() {
        fn shared<T: Send + Sync>() {}
        shared::<Video>();
    }
}
