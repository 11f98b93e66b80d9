//! Errors of a clip, its decoder or a request.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::shown;

/// Reason why a clip or one of its frames cannot be read.
///
/// ```
/// use taceva_video::{Decoders, Video, VideoError};
/// let error = Video::open("absent.mp4".as_ref(), &Decoders::default()).unwrap_err();
/// assert!(matches!(error, VideoError::Io { .. }));
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VideoError {
    /// The file, or a program that reads it, could not be used.
    #[error("cannot {doing} {}: {source}", shown(path))]
    Io {
        /// Clip.
        path: PathBuf,
        /// Failed action, as a verb.
        doing: &'static str,
        /// System error.
        source: io::Error,
    },
    /// Bytes contradict the format of the container or of the stream.
    #[error("{} is damaged at byte {offset}: {problem}", shown(path))]
    Damaged {
        /// Clip.
        path: PathBuf,
        /// Byte offset in the file.
        offset: u64,
        /// Found value and expected value.
        problem: String,
    },
    /// The index of the container contradicts its frames.
    #[error(
        "the index of {} is broken at byte {offset}: {problem}; `ffmpeg -i OLD -c copy NEW` rebuilds it",
        shown(path)
    )]
    Index {
        /// Clip.
        path: PathBuf,
        /// Byte offset of the index entry in the file.
        offset: u64,
        /// Value of the index and found value.
        problem: String,
    },
    /// A size exceeds its limit. Nothing was allocated for it.
    #[error("{}: {what}: {found}, at most {limit} are accepted", shown(path))]
    TooLarge {
        /// Clip.
        path: PathBuf,
        /// Counted quantity.
        what: &'static str,
        /// Stated size.
        found: u64,
        /// Maximum accepted size.
        limit: u64,
    },
    /// The clip has no frame with the requested index.
    #[error(
        "{}: no frame {index}: there are {frames}, counted from 0",
        shown(path)
    )]
    NoFrame {
        /// Clip.
        path: PathBuf,
        /// Requested frame, from 0.
        index: u64,
        /// Number of frames.
        frames: u64,
    },
    /// Requested frames are not strictly ascending.
    #[error(
        "{}: frame {index} is requested after frame {after}, expected ascending numbers",
        shown(path)
    )]
    Unsorted {
        /// Clip.
        path: PathBuf,
        /// Frame out of order.
        index: u64,
        /// Frame before it.
        after: u64,
    },
    /// The size of a frame differs from the size of the first frame.
    #[error(
        "{}: frame {frame} is {found}, expected {expected} as in the first frame: split the clip where its size changes",
        shown(path)
    )]
    ChangedSize {
        /// Clip.
        path: PathBuf,
        /// Frame, from 0.
        frame: u64,
        /// Size of the frame, `width×height` in pixels.
        found: String,
        /// Size of the clip.
        expected: String,
    },
    /// No available decoder supports the clip.
    #[error("{}: no available decoder supports {codec}: {remedy}", shown(path))]
    NoDecoder {
        /// Clip.
        path: PathBuf,
        /// Codec, with the unsupported profile or pixel format.
        codec: String,
        /// Remedy.
        remedy: String,
    },
    /// The clip has no luma plane.
    #[error(
        "{}: pixel format {pixel_format} has no luma plane: request colours",
        shown(path)
    )]
    NoLuma {
        /// Clip.
        path: PathBuf,
        /// Pixel format.
        pixel_format: String,
    },
    /// The colour matrix of the clip is not supported.
    #[error(
        "{}: colours use matrix {matrix} of ITU-T H.273, which is not supported: request luma, or re-encode the clip with another matrix",
        shown(path)
    )]
    Colours {
        /// Clip.
        path: PathBuf,
        /// Matrix number of ITU-T H.273.
        matrix: u16,
    },
    /// The decoder rejected the stream.
    #[error("{}: {decoder} does not decode frame {frame}: {problem}", shown(path))]
    Decoder {
        /// Clip.
        path: PathBuf,
        /// Library or program.
        decoder: &'static str,
        /// First missing frame, from 0 in presentation order.
        frame: u64,
        /// Message of the decoder.
        problem: String,
    },
    /// A decoder program was killed, ended early, was too slow or broke the protocol.
    #[error("{}: {program}: {problem}", shown(path))]
    Process {
        /// Clip.
        path: PathBuf,
        /// Program.
        program: String,
        /// Reason.
        problem: String,
    },
}

impl VideoError {
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> VideoError {
        let path = path.to_owned();
        move |source| VideoError::Io {
            path,
            doing,
            source,
        }
    }

    pub(crate) fn damaged(path: &Path, offset: u64, problem: impl Into<String>) -> VideoError {
        VideoError::Damaged {
            path: path.to_owned(),
            offset,
            problem: problem.into(),
        }
    }
}

/// Reason why a visit of frames ended early.
///
/// ```
/// use taceva_video::{Colours, Decoders, Video, VisitError};
/// # let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../tests/recordings/avi-mjpeg/cube_1.avi");
/// let clip = Video::open(file.as_ref(), &Decoders::default())?;
/// let enough = clip.visit(&[0, 1], Colours::Luma, &mut |_, _| Err("enough"));
/// assert!(matches!(enough, Err(VisitError::Caller("enough"))));
/// let beyond = clip.visit(&[99], Colours::Luma, &mut |_, _| Ok::<(), &str>(()));
/// assert!(matches!(beyond, Err(VisitError::Video(_))));
/// # Ok::<(), taceva_video::VideoError>(())
/// ```
#[derive(Debug, thiserror::Error)]
pub enum VisitError<E> {
    /// The clip could not be read or decoded.
    #[error(transparent)]
    Video(#[from] VideoError),
    /// Error of the caller. It ended the visit.
    #[error("{0}")]
    Caller(E),
}
