//! Clips that an external ffmpeg decodes: any container and codec that it knows.
//!
//! It looks through the whole clip once when the clip is opened, so that the number of frames, their times, and whether anything in it is damaged
//! or changes its size are known, and once more up to the last frame that is wanted. No pixel is converted by it: raw frames are taken in the
//! format of the codec, of which luma is cut out here. The clip is its standard input, which it reads as a file: no name is shown to it, and
//! it may open nothing but files.

mod format;
mod picture;
mod said;

use std::ffi::OsStr;
use std::fs::File;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::clip::{Colours, Picture, VideoInfo};
use crate::colour::YuvCoding;
use crate::error::VideoError;
use crate::limits;
use crate::process::{Ended, Piece, Running, blocks_of};

use format::Layout;
use picture::{RawFrame, Refused};
use said::{Said, value};

/// A clip that ffmpeg decodes.
#[derive(Debug)]
pub(crate) struct ForeignClip {
    path: PathBuf,
    program: PathBuf,
    frame: RawFrame,
    frame_bytes: usize,
    pixel_format: String,
    frames: u64,
}

/// What is known of a clip before ffmpeg looks at it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    container: Option<&'static str>,
    codec: Option<String>,
    /// Why it is not decoded here, behind the name of the codec; empty where the codec says it all.
    why: &'static str,
}

impl Known {
    pub(crate) fn new(container: &'static str, codec: Option<String>, why: &'static str) -> Known {
        Known {
            container: Some(container),
            codec,
            why,
        }
    }

    /// The codec and what is the matter with it.
    fn codec(&self) -> String {
        let codec = self
            .codec
            .as_deref()
            .unwrap_or("the codec of a container that is not known here");
        [codec, self.why].join(" ").trim().to_owned()
    }

    /// That nothing at hand decodes it.
    pub(crate) fn no_decoder(&self, path: &Path) -> VideoError {
        VideoError::NoDecoder {
            path: path.to_owned(),
            codec: self.codec(),
            remedy: "install ffmpeg 5.1 or later (`pip install imageio-ffmpeg` brings one), or name it by `--ffmpeg PROGRAM` or TACEVA_FFMPEG".to_owned(),
        }
    }
}

/// What the first look says.
#[derive(Debug, Default)]
struct Look {
    version: Option<String>,
    container: Option<String>,
    codec: Option<String>,
    /// Seconds of a tick.
    tick_s: Option<f64>,
    times_s: Vec<Option<f64>>,
    /// Pixel format and size of the first frame.
    first: Option<(String, u32, u32)>,
    colours: Option<YuvCoding>,
    fault: Option<String>,
}

impl ForeignClip {
    /// Has ffmpeg look through the clip at `path`, of which `known` is known already.
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
            return Err(process("it finds no frame"));
        };
        let lossy = look.codec.as_deref().and_then(is_lossy);
        let layout = Layout::of(&pixel_format);
        let sized = layout.and_then(|layout| Some((layout, layout.frame_bytes(width, height)?)));
        let Some((layout, frame_bytes)) = sized else {
            return Err(VideoError::NoDecoder {
                path: path.to_owned(),
                codec: format!("{} with pixels as {pixel_format}", known.codec()),
                remedy: "write it anew in a format that is read, as `ffmpeg -i OLD -pix_fmt bgr0 -c:v ffv1 NEW.mkv` does".to_owned(),
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
        let codec = known.codec.clone().or(look.codec);
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
            codec: codec.unwrap_or_default(),
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

    /// Shows the frames of `sorted`, which are there.
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
        let raw = ["-frames:v", &count, "-f", "rawvideo", "pipe:1"];
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
                    "it gave {next} frames, expected the {} that it found before",
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

impl Look {
    fn at(path: &Path, program: &Path, known: &Known) -> Result<Look, VideoError> {
        let arguments = ["-vf", "showinfo=checksum=0", "-f", "null", "-"];
        let command = command(path, program, &arguments)?;
        let mut running = match Running::start(command, None) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                return Err(known.no_decoder(path));
            }
            other => other.map_err(not_started(path, program))?,
        };
        bound_memory(&mut running);
        let mut look = Look::default();
        let ended = loop {
            match running.next() {
                Ok(Piece::Line(line)) => look.hear(path, &line)?,
                Ok(Piece::Block(_)) => {}
                Err(ended) => break ended,
            }
        };
        check_end(path, program, &ended, look.fault.take())?;
        Ok(look)
    }

    fn hear(&mut self, path: &Path, line: &str) -> Result<(), VideoError> {
        note_fault(&mut self.fault, line);
        let said = Said::parse(line);
        if let Some(shown) = said.shown() {
            if shown.starts_with("n:") {
                self.frame(path, shown)?;
            } else if shown.starts_with("config in") {
                let tick = value(shown, "time_base:").and_then(|tick| tick.split_once('/'));
                let tick = tick.and_then(|(over, under)| {
                    Some((over.parse::<f64>().ok()?, under.parse::<f64>().ok()?))
                });
                self.tick_s = tick
                    .filter(|(_, under)| *under > 0.0)
                    .map(|(over, under)| over / under);
            } else if self.colours.is_none() {
                self.colours = value(shown, "color_space:").map(|matrix| YuvCoding {
                    matrix: said::matrix(matrix),
                    is_full_range: value(shown, "color_range:") == Some("pc"),
                });
            }
        } else if let Some(version) = said.text.strip_prefix("ffmpeg version ") {
            self.version = version.split(' ').next().map(str::to_owned);
        } else if let Some(container) = said.text.strip_prefix("Input #0, ") {
            self.container = container
                .rsplit_once(", from ")
                .map(|(names, _)| names.to_owned());
        } else if let Some(mapped) = said.text.strip_prefix("  Stream #0:") {
            // Of the mapping: `0 -> #0:0 (h264 (native) -> rawvideo (native))`.
            let codec = mapped
                .split_once(" -> #0:0 (")
                .and_then(|(_, rest)| rest.split(' ').next());
            self.codec = self.codec.take().or(codec.map(str::to_owned));
        }
        Ok(())
    }

    /// A frame, `n:   0 pts:      0 pts_time:0 … fmt:yuv420p … s:64x48 …`.
    fn frame(&mut self, path: &Path, shown: &str) -> Result<(), VideoError> {
        let size = value(shown, " s:").and_then(|size| size.split_once('x'));
        let size = size.and_then(|(width, height)| {
            Some((width.parse::<u32>().ok()?, height.parse::<u32>().ok()?))
        });
        let (Some(format), Some((width, height))) = (value(shown, " fmt:"), size) else {
            return Ok(());
        };
        let frame = self.times_s.len() as u64;
        if frame == limits::FRAMES {
            return Err(VideoError::TooLarge {
                path: path.to_owned(),
                what: "frames of a clip",
                found: frame + 1,
                limit: limits::FRAMES,
            });
        }
        match &self.first {
            None => self.first = Some((format.to_owned(), width, height)),
            Some((first, w, h)) if (first.as_str(), *w, *h) == (format, width, height) => {}
            Some((first, w, h)) => {
                return Err(VideoError::ChangedSize {
                    path: path.to_owned(),
                    frame,
                    found: format!("{width}×{height} {format}"),
                    expected: format!("{w}×{h} {first}"),
                });
            }
        }
        let ticks = value(shown, " pts:").and_then(|ticks| ticks.parse::<f64>().ok());
        self.times_s
            .push(ticks.zip(self.tick_s).map(|(ticks, tick_s)| ticks * tick_s));
        Ok(())
    }
}

/// ffmpeg with the clip as its input, every frame of its first video stream taken as it is, and `output`.
fn command(path: &Path, program: &Path, output: &[&str]) -> Result<Command, VideoError> {
    let file = File::open(path).map_err(VideoError::io("open", path))?;
    let mut command = Command::new(program);
    command.args(["-nostdin", "-nostats", "-loglevel", "level+info"]);
    // Damage is an error and not a guess; sizes are bounded; nothing but files is opened, and no list that names others is read.
    command.args([
        "-xerror",
        "-max_pixels",
        MAX_PIXELS,
        "-max_alloc",
        MAX_ALLOCATED,
    ]);
    command.args([
        "-protocol_whitelist",
        "file",
        "-format_whitelist",
        CONTAINERS,
    ]);
    command.arg("-noautorotate").arg("-i");
    #[cfg(unix)]
    command.arg("file:/dev/fd/0");
    #[cfg(not(unix))]
    command.arg({
        let mut named = std::ffi::OsString::from("file:");
        named.push(path);
        named
    });
    command.args(["-map", "0:v:0"].iter().chain(output).map(OsStr::new));
    command.stdin(Stdio::from(file));
    // It would write a file of its own.
    command.env_remove("FFREPORT");
    Ok(command)
}

const MAX_PIXELS: &str = "67108864";
const MAX_ALLOCATED: &str = "1073741824";

/// Containers and bare streams that hold their frames themselves, by the names of ffmpeg.
const CONTAINERS: &str = "avi,matroska,mov,mpegts,mpeg,mpegvideo,m4v,h264,hevc,obu,ivf,ogg,flv,asf,mxf,nut,dv,gif,mjpeg,yuv4mpegpipe";

fn not_started(path: &Path, program: &Path) -> impl FnOnce(std::io::Error) -> VideoError {
    let (path, program) = (path.to_owned(), program.display().to_string());
    move |error| VideoError::Process {
        path,
        program,
        problem: format!("does not start: {error}"),
    }
}

/// Bounds the memory of the program, where the system can do that from without.
fn bound_memory(running: &mut Running) {
    #[cfg(target_os = "linux")]
    {
        use rustix::process::{Pid, Resource, Rlimit, prlimit};
        let limit = Rlimit {
            current: Some(limits::PROGRAM_BYTES),
            maximum: Some(limits::PROGRAM_BYTES),
        };
        // One that has ended already needs no limit.
        let _ = prlimit(Some(Pid::from_child(running.child())), Resource::As, limit);
    }
    #[cfg(not(target_os = "linux"))]
    let _ = running;
}

fn note_fault(fault: &mut Option<String>, line: &str) {
    let said = Said::parse(line);
    if fault.is_none() && said.is_fault() {
        *fault = Some(said.text.trim().to_owned());
    }
}

/// Whether a program that ended did what it was asked for.
fn check_end(
    path: &Path,
    program: &Path,
    ended: &Ended,
    fault: Option<String>,
) -> Result<(), VideoError> {
    let problem = match (ended, fault) {
        (Ended::By(status), None) if status.success() => return Ok(()),
        (_, None) => ended.to_string(),
        (_, Some(fault)) => taceva_core::shown(&fault).to_string(),
    };
    Err(VideoError::Process {
        path: path.to_owned(),
        program: program.display().to_string(),
        problem,
    })
}

/// Whether a codec loses detail, by the name that ffmpeg gives it; nothing of those that do either.
fn is_lossy(codec: &str) -> Option<bool> {
    match codec {
        "ffv1" | "huffyv" | "huffyuv" | "ffvhuff" | "utvideo" | "rawvideo" | "png" | "gif"
        | "v210" | "magicyuv" => Some(false),
        "mpeg4" | "mpeg1video" | "mpeg2video" | "mjpeg" | "msmpeg4v2" | "msmpeg4v3" | "vp8"
        | "theora" | "prores" | "wmv1" | "wmv2" => Some(true),
        _ => None,
    }
}
