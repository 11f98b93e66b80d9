//! Command line and restrictions of ffmpeg, and the check of its exit.

use std::ffi::OsStr;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};

use super::log::Said;
use crate::error::VideoError;
use crate::limits;
use crate::process::{Ended, Running};

/// Command that runs ffmpeg with the arguments `output`. The input is the first video stream of the clip, not rotated.
pub(super) fn command(path: &Path, program: &Path, output: &[&str]) -> Result<Command, VideoError> {
    let file = File::open(path).map_err(VideoError::io("open", path))?;
    let mut command = Command::new(program);
    command.args(["-nostdin", "-nostats", "-loglevel", "level+info"]);
    // Treats damage as an error, limits sizes and opens only files. Playlists that name other files are not read.
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
    // ffmpeg would write a report file.
    command.env_remove("FFREPORT");
    Ok(command)
}

const MAX_PIXELS: &str = "67108864";
const MAX_ALLOCATED: &str = "1073741824";

/// Containers and raw streams that refer to no other file, as ffmpeg names them.
const CONTAINERS: &str = "avi,matroska,mov,mpegts,mpeg,mpegvideo,m4v,h264,hevc,obu,ivf,ogg,flv,asf,mxf,nut,dv,gif,mjpeg,yuv4mpegpipe";

pub(super) fn not_started(
    path: &Path,
    program: &Path,
) -> impl FnOnce(std::io::Error) -> VideoError {
    let (path, program) = (path.to_owned(), program.display().to_string());
    move |error| VideoError::Process {
        path,
        program,
        problem: format!("does not start: {error}"),
    }
}

/// Limits the address space of the child process. Has an effect only on Linux.
pub(super) fn bound_memory(running: &mut Running) {
    #[cfg(target_os = "linux")]
    {
        use rustix::process::{Pid, Resource, Rlimit, prlimit};
        let limit = Rlimit {
            current: Some(limits::PROGRAM_BYTES),
            maximum: Some(limits::PROGRAM_BYTES),
        };
        // A program that has already ended needs no limit.
        let _ = prlimit(Some(Pid::from_child(running.child())), Resource::As, limit);
    }
    #[cfg(not(target_os = "linux"))]
    let _ = running;
}

pub(super) fn note_fault(fault: &mut Option<String>, line: &str) {
    let said = Said::parse(line);
    if fault.is_none() && said.is_fault() {
        *fault = Some(said.text.trim().to_owned());
    }
}

/// Checks the exit status and the error output of a program.
pub(super) fn check_end(
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
