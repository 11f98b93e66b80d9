//! Clips decoded by the external program ffmpeg, in any container and codec that ffmpeg supports.
//!
//! When a clip is opened, ffmpeg decodes the whole clip once. This run gives the number of frames and their times, and detects damage and changes of
//! size. A visit decodes the clip again up to the last requested frame. ffmpeg converts no pixels; raw frames arrive in the format of the codec, and
//! this module extracts the luma or converts the colours. The clip is the standard input of ffmpeg, so ffmpeg receives no file name. ffmpeg may open
//! only files.

mod command;
mod format;
mod log;
mod picture;
mod probe;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::clip::{Colours, Picture, VideoInfo};
use crate::colour::YuvCoding;
use crate::error::VideoError;
use crate::limits;
use crate::process::{Piece, Running, blocks_of};

use command::{bound_memory, check_end, command, not_started, note_fault};
use format::Layout;
use picture::{RawFrame, Refused};
use probe::Look;

/// Clip decoded by ffmpeg.
#[derive(Debug)]
pub(crate) struct ForeignClip {
    path: PathBuf,
    program: PathBuf,
    frame: RawFrame,
    frame_bytes: usize,
    pixel_format: String,
    frames: u64,
}

/// Properties of a clip that are known before ffmpeg runs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    container: Option<&'static str>,
    codec: Option<String>,
    /// Reason why this process cannot decode the clip, to be appended to the name of the codec. Empty if the codec itself is the reason.
    why: String,
}

impl Known {
    pub(crate) fn new(container: &'static str, codec: Option<String>, why: &str) -> Known {
        Known {
            container: Some(container),
            codec,
            why: why.to_owned(),
        }
    }

    /// Name of the codec, followed by the reason.
    fn codec(&self) -> String {
        let codec = self
            .codec
            .as_deref()
            .unwrap_or("the codec of an unknown container");
        [codec, &self.why].join(" ").trim().to_owned()
    }

    /// Error for a clip without an available decoder.
    pub(crate) fn no_decoder(&self, path: &Path) -> VideoError {
        VideoError::NoDecoder {
            path: path.to_owned(),
            codec: self.codec(),
            remedy: "install ffmpeg 5.1 or later (`pip install imageio-ffmpeg` includes one), or name it by `--ffmpeg PROGRAM` or TACEVA_FFMPEG".to_owned(),
        }
    }
}

impl ForeignClip {
    /// Runs ffmpeg over the clip at `path` with the properties `known`, to find its frames.
    pub(crate) fn open(
        path: &Path,
        program: &Path,
        known: &Known,
    ) -> Result<(VideoInfo, ForeignClip), VideoError> {
        let look = Look::at(path, program, known)?;
        let process = |problem: &str| VideoError::Process {
            path: path.to_owned(),
            program: program.display().to_string(),
            problem: problem.to_owned(),
        };
        let Some((pixel_format, width, height)) = look.first else {
            return Err(process("it found no frame"));
        };
        let known = Known {
            codec: known.codec.clone().or(look.codec.clone()),
            ..known.clone()
        };
        let lossy = look.codec.as_deref().and_then(is_lossy);
        let layout = Layout::of(&pixel_format);
        let sized = layout.and_then(|layout| Some((layout, layout.frame_bytes(width, height)?)));
        let Some((layout, frame_bytes)) = sized else {
            return Err(VideoError::NoDecoder {
                path: path.to_owned(),
                codec: format!("{} with pixel format {pixel_format}", known.codec()),
                remedy:
                    "convert it, for example with `ffmpeg -i OLD -pix_fmt bgr0 -c:v ffv1 NEW.mkv`"
                        .to_owned(),
            });
        };
        if frame_bytes as u64 > limits::FRAME_BYTES {
            return Err(VideoError::TooLarge {
                path: path.to_owned(),
                what: "bytes of a decoded frame",
                found: frame_bytes as u64,
                limit: limits::FRAME_BYTES,
            });
        }
        let coding = look.colours.unwrap_or(YuvCoding {
            matrix: None,
            is_full_range: false,
        });
        let always_full = matches!(
            layout,
            Layout::Planar {
                is_full_range: true,
                ..
            }
        );
        let frames = look.times_s.len() as u64;
        let info = VideoInfo {
            container: known
                .container
                .map(str::to_owned)
                .or(look.container)
                .unwrap_or_default(),
            codec: known.codec.unwrap_or_default(),
            pixel_format: pixel_format.clone(),
            width,
            height,
            frames,
            times_s: look.times_s.into_iter().collect(),
            lossy,
            decoder: Some(
                format!("ffmpeg {}", look.version.unwrap_or_default())
                    .trim_end()
                    .to_owned(),
            ),
        };
        let clip = ForeignClip {
            path: path.to_owned(),
            program: program.to_owned(),
            frame: RawFrame {
                layout,
                width,
                height,
                coding: YuvCoding {
                    is_full_range: coding.is_full_range || always_full,
                    ..coding
                },
            },
            frame_bytes,
            pixel_format,
            frames,
        };
        Ok((info, clip))
    }

    /// Calls `each` with the frames whose indices are in `sorted`. All these frames must exist.
    pub(crate) fn visit(
        &self,
        sorted: &[u64],
        colours: Colours,
        each: &mut dyn FnMut(u64, Picture) -> ControlFlow<()>,
    ) -> Result<(), VideoError> {
        let Some(last) = sorted.last() else {
            return Ok(());
        };
        let count = (last + 1).to_string();
        // Outputs each frame once at any time. Otherwise ffmpeg repeats and drops frames of a variable rate.
        let raw = [
            "-frames:v",
            &count,
            "-fps_mode",
            "passthrough",
            "-f",
            "rawvideo",
            "pipe:1",
        ];
        let command = command(&self.path, &self.program, &raw)?;
        let running = Running::start(command, Some(blocks_of(self.frame_bytes)));
        let mut running = running.map_err(not_started(&self.path, &self.program))?;
        bound_memory(&mut running);
        let mut wanted = sorted.iter().peekable();
        let (mut next, mut fault) = (0, None);
        let ended = loop {
            match running.next() {
                Ok(Piece::Block(block)) => {
                    if block.len() == self.frame_bytes && wanted.next_if_eq(&&next).is_some() {
                        let picture = self
                            .frame
                            .picture(block, colours)
                            .map_err(|refused| self.refusal(refused))?;
                        if each(next, picture).is_break() {
                            return Ok(());
                        }
                    }
                    next += 1;
                }
                Ok(Piece::Line(line)) => note_fault(&mut fault, &line),
                Err(ended) => break ended,
            }
        };
        check_end(&self.path, &self.program, &ended, fault)?;
        match wanted.next() {
            None => Ok(()),
            Some(_) => Err(VideoError::Process {
                path: self.path.clone(),
                program: self.program.display().to_string(),
                problem: format!(
                    "it returned {next} frames, expected the {} of its first pass",
                    self.frames
                ),
            }),
        }
    }

    fn refusal(&self, refused: Refused) -> VideoError {
        match refused {
            Refused::NoLuma => VideoError::NoLuma {
                path: self.path.clone(),
                pixel_format: self.pixel_format.clone(),
            },
            Refused::Matrix(matrix) => matrix.at(&self.path),
        }
    }
}

/// True for a lossy codec, by its name in ffmpeg; `None` for unknown codecs and codecs with lossy and lossless modes.
fn is_lossy(codec: &str) -> Option<bool> {
    match codec {
        "ffv1" | "huffyv" | "huffyuv" | "ffvhuff" | "utvideo" | "rawvideo" | "png" | "gif"
        | "v210" | "magicyuv" => Some(false),
        "mpeg4" | "mpeg1video" | "mpeg2video" | "mjpeg" | "msmpeg4v2" | "msmpeg4v3" | "vp8"
        | "theora" | "prores" | "wmv1" | "wmv2" => Some(true),
        _ => None,
    }
}
