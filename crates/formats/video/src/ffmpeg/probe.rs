//! First run of ffmpeg over a clip, in which ffmpeg reports each frame.

use std::path::Path;

use super::Known;
use super::command::{bound_memory, check_end, command, not_started, note_fault};
use super::log::{self, Said, value};
use crate::colour::YuvCoding;
use crate::error::VideoError;
use crate::limits;
use crate::process::{Piece, Running};

/// Result of the first run.
#[derive(Debug, Default)]
pub(super) struct Look {
    pub(super) version: Option<String>,
    pub(super) container: Option<String>,
    pub(super) codec: Option<String>,
    /// Duration of a tick of the time stamps, s; `None` before it is reported.
    tick_s: Option<f64>,
    pub(super) times_s: Vec<Option<f64>>,
    /// Pixel format and size of the first frame.
    pub(super) first: Option<(String, u32, u32)>,
    pub(super) colours: Option<YuvCoding>,
    fault: Option<String>,
}

impl Look {
    /// Decodes the whole clip with the properties `known`.
    pub(super) fn at(path: &Path, program: &Path, known: &Known) -> Result<Look, VideoError> {
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
                    matrix: log::matrix(matrix),
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
            // Line of the stream mapping: `0 -> #0:0 (h264 (native) -> rawvideo (native))`.
            let codec = mapped
                .split_once(" -> #0:0 (")
                .and_then(|(_, rest)| rest.split(' ').next());
            self.codec = self.codec.take().or(codec.map(str::to_owned));
        }
        Ok(())
    }

    /// Parses the report on a frame: `n:   0 pts:      0 pts_time:0 … fmt:yuv420p … s:64x48 …`.
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
