//! What can be wrong with a clip, its decoder or a question asked of it.

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::shown;

/// Why a clip or one of its frames cannot be given.
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
        /// The clip.
        path: PathBuf,
        /// What was tried, as a verb.
        doing: &'static str,
        /// What the system said.
        source: io::Error,
    },
    /// Bytes contradict the format of the container or of the stream in it.
    #[error("{} is damaged at byte {offset}: {problem}", shown(path))]
    Damaged {
        /// The clip.
        path: PathBuf,
        /// Where, from the beginning of the file.
        offset: u64,
        /// What was found there, and what was expected.
        problem: String,
    },
    /// The index of the container contradicts the frames that lie in it.
    #[error(
        "the index of {} is broken at byte {offset}: {problem}; `ffmpeg -i OLD -c copy NEW` writes it anew",
        shown(path)
    )]
    Index {
        /// The clip.
        path: PathBuf,
        /// Where the index says so, from the beginning of the file.
        offset: u64,
        /// What it says, and what there is.
        problem: String,
    },
    /// Something is larger than is accepted; nothing was allocated for it.
    #[error("{}: {what}: {found}, at most {limit} are accepted", shown(path))]
    TooLarge {
        /// The clip.
        path: PathBuf,
        /// What is counted.
        what: &'static str,
        /// How many there are, as the file says.
        found: u64,
        /// How many are accepted.
        limit: u64,
    },
    /// A frame was asked for that the clip does not have.
    #[error("{}: no frame {index}, there are {frames} from 0", shown(path))]
    NoFrame {
        /// The clip.
        path: PathBuf,
        /// The frame that was asked for, from 0.
        index: u64,
        /// How many frames there are.
        frames: u64,
    },
    /// Frames were not asked for in rising order, each once.
    #[error(
        "{}: frame {index} is asked for after frame {after}, expected rising numbers",
        shown(path)
    )]
    Unsorted {
        /// The clip.
        path: PathBuf,
        /// The frame that came too late.
        index: u64,
        /// The one before it.
        after: u64,
    },
    /// A frame is not as large as the first.
    #[error(
        "{}: frame {frame} is {found}, expected {expected} as at the beginning: cut the clip where its size changes",
        shown(path)
    )]
    ChangedSize {
        /// The clip.
        path: PathBuf,
        /// The frame, from 0.
        frame: u64,
        /// Its size, `width×height` in pixels.
        found: String,
        /// The size of the clip.
        expected: String,
    },
    /// Nothing at hand decodes the clip.
    #[error("{}: nothing at hand decodes {codec}: {remedy}", shown(path))]
    NoDecoder {
        /// The clip.
        path: PathBuf,
        /// The codec, with the profile or pixel format that is the difficulty.
        codec: String,
        /// What would mend it.
        remedy: String,
    },
    /// The luma plane was asked of a clip that has none.
    #[error(
        "{}: pixels are {pixel_format}, which have no luma plane: ask for colours",
        shown(path)
    )]
    NoLuma {
        /// The clip.
        path: PathBuf,
        /// How its pixels are stored.
        pixel_format: String,
    },
    /// Colours were asked of a clip whose matrix is not known here.
    #[error(
        "{}: colours are coded by matrix {matrix} of ITU-T H.273, which is not converted: ask for luma, or write the clip anew by another",
        shown(path)
    )]
    Colours {
        /// The clip.
        path: PathBuf,
        /// The number of the matrix.
        matrix: u16,
    },
    /// The decoder refused the stream.
    #[error("{}: {decoder} does not decode frame {frame}: {problem}", shown(path))]
    Decoder {
        /// The clip.
        path: PathBuf,
        /// The library or program.
        decoder: &'static str,
        /// The first frame that it did not give, from 0 in the order of presentation.
        frame: u64,
        /// What it said.
        problem: String,
    },
    /// A program that decodes was killed, ended early, was too slow or did not speak as it should.
    #[error("{}: {program}: {problem}", shown(path))]
    Process {
        /// The clip.
        path: PathBuf,
        /// The program.
        program: String,
        /// What became of it.
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

/// Why a visit of frames ended early.
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
    /// The caller's own error, which ended the visit.
    #[error("{0}")]
    Caller(E),
}
