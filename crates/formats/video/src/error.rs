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
    /// The file, or a program that reads the file, could not be used.
    #[error("cannot {doing} {}: {source}", shown(path))]
    Io {
        /// Path of the clip.
        path: PathBuf,
        /// Failed operation, as a verb.
        doing: &'static str,
        /// Error of the operating system.
        source: io::Error,
    },
    /// Bytes contradict the format of the container or of the stream.
    #[error("{} is damaged at byte {offset}: {problem}", shown(path))]
    Damaged {
        /// Path of the clip.
        path: PathBuf,
        /// Byte offset in the file.
        offset: u64,
        /// Value found, and value expected.
        problem: String,
    },
    /// The index of the container contradicts its frames.
    #[error(
        "the index of {} is broken at byte {offset}: {problem}; `ffmpeg -i OLD -c copy NEW` rebuilds it",
        shown(path)
    )]
    Index {
        /// Path of the clip.
        path: PathBuf,
        /// Byte offset of the index entry in the file.
        offset: u64,
        /// Value in the index, and value found.
        problem: String,
    },
    /// A size exceeds its limit. No memory was allocated.
    #[error("{}: {what}: {found}, at most {limit} are accepted", shown(path))]
    TooLarge {
        /// Path of the clip.
        path: PathBuf,
        /// Limited quantity with its unit, such as `bytes of a decoded frame`.
        what: &'static str,
        /// Stated size.
        found: u64,
        /// Maximum accepted value.
        limit: u64,
    },
    /// The clip has no frame with the requested index.
    #[error(
        "{}: frame {index} was requested, but there are {frames} frames, counted from 0",
        shown(path)
    )]
    NoFrame {
        /// Path of the clip.
        path: PathBuf,
        /// Requested frame, from 0.
        index: u64,
        /// Number of frames.
        frames: u64,
    },
    /// The requested frames are not strictly ascending.
    #[error(
        "{}: frame {index} is requested after frame {after}, expected ascending numbers",
        shown(path)
    )]
    Unsorted {
        /// Path of the clip.
        path: PathBuf,
        /// Index of the frame that is out of order.
        index: u64,
        /// Index of the frame that was requested before this frame.
        after: u64,
    },
    /// The size of a frame differs from the size of the first frame.
    #[error(
        "{}: frame {frame} is {found}, expected {expected} as in the first frame: split the clip where its size changes",
        shown(path)
    )]
    ChangedSize {
        /// Path of the clip.
        path: PathBuf,
        /// Index of the frame, from 0.
        frame: u64,
        /// Size of the frame, `width×height` in pixels.
        found: String,
        /// Size of the first frame, `width×height` in pixels.
        expected: String,
    },
    /// No available decoder supports the clip.
    #[error("{}: no available decoder supports {codec}: {remedy}", shown(path))]
    NoDecoder {
        /// Path of the clip.
        path: PathBuf,
        /// Codec, with the unsupported profile or pixel format.
        codec: String,
        /// Remedy for the user, such as the installation of ffmpeg.
        remedy: String,
    },
    /// The clip has no luma plane.
    #[error(
        "{}: pixel format {pixel_format} has no luma plane: request colours",
        shown(path)
    )]
    NoLuma {
        /// Path of the clip.
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
        /// Path of the clip.
        path: PathBuf,
        /// Matrix number of ITU-T H.273.
        matrix: u16,
    },
    /// The decoder rejected the stream.
    #[error("{}: {decoder} does not decode frame {frame}: {problem}", shown(path))]
    Decoder {
        /// Path of the clip.
        path: PathBuf,
        /// Name of the decoder library or program.
        decoder: &'static str,
        /// Index of the first frame that the decoder did not return, from 0 in presentation order.
        frame: u64,
        /// Message of the decoder.
        problem: String,
    },
    /// A decoder program was killed, ended early, was too slow or broke the protocol.
    #[error("{}: {program}: {problem}", shown(path))]
    Process {
        /// Path of the clip.
        path: PathBuf,
        /// Name of the program.
        program: String,
        /// Reason for the failure.
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
    /// Error of the caller, which ended the visit.
    #[error("{0}")]
    Caller(E),
}
