//! Trace of a program under `strace`: its operations on a watched folder.

use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};

use super::follower::Follower;
use super::model::Disk;
use super::operation::Operation;
use super::tree::{Tree, read_tree};

/// System calls to trace: the supported ones, and those that must not touch the watched folder, because the trace does not show the bytes that they
/// write.
const TRACED: &str = "trace=open,openat,openat2,creat,close,close_range,dup,dup2,dup3,fcntl,lseek,\
    write,pwrite64,writev,pwritev,pwritev2,ftruncate,truncate,fallocate,\
    copy_file_range,sendfile,splice,mmap,io_uring_setup,\
    rename,renameat,renameat2,link,linkat,symlink,symlinkat,unlink,unlinkat,rmdir,mkdir,mkdirat,mknod,mknodat,\
    fsync,fdatasync,sync_file_range,sync,syncfs,chdir,fchdir,clone,clone3,fork,vfork";

/// Reason why there is no trace.
#[derive(Debug)]
pub enum TraceError {
    /// `strace` is missing, or has no permission to trace. The test may then skip itself, and must report this.
    NoStrace(String),
    /// An unsupported call touched the watched folder, or model and disk differ.
    Unfollowed(String),
}

impl std::fmt::Display for TraceError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            TraceError::NoStrace(why) => write!(f, "no system calls can be traced here: {why}"),
            TraceError::Unfollowed(what) => write!(f, "the trace cannot be followed: {what}"),
        }
    }
}

impl std::error::Error for TraceError {}

/// Operations of a program, with the initial state.
#[derive(Debug)]
pub struct Trace {
    /// Initial state of the watched folder.
    pub initial: Disk,
    /// Operations, in order.
    pub operations: Vec<Operation>,
    /// Exit status of the program.
    pub status: ExitStatus,
    /// Text that the program wrote to standard error.
    pub complaint: String,
}

impl Trace {
    /// Runs `command` and traces its operations on the folder at `watched`, whose content must equal `initial`.
    ///
    /// # Errors
    /// [`TraceError::NoStrace`] if programs cannot be traced; [`TraceError::Unfollowed`] for an unsupported call. The model is compared
    /// with the disk at the end, so every missed change is an error.
    pub fn run(command: &Command, watched: &Path, initial: Disk) -> Result<Trace, TraceError> {
        let unfollowed = |error: std::io::Error| TraceError::Unfollowed(error.to_string());
        let log = tempfile::NamedTempFile::new().map_err(unfollowed)?;
        let mut strace = Command::new("strace");
        strace
            .args([
                "-f",
                "-qq",
                "-xx",
                "-s",
                "16777216",
                "-e",
                "signal=none",
                "-e",
                TRACED,
                "-o",
            ])
            .arg(log.path())
            .arg(command.get_program())
            .args(command.get_args())
            .current_dir(watched)
            .stdin(Stdio::null());
        let output = strace
            .output()
            .map_err(|error| TraceError::NoStrace(format!("strace: {error}")))?;
        let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
        let text = std::fs::read_to_string(log.path()).map_err(unfollowed)?;
        if text.is_empty() {
            return Err(TraceError::NoStrace(complaint));
        }
        let mut follower = Follower::new(watched, initial.clone());
        for line in text.lines() {
            follower.follow(line).map_err(TraceError::Unfollowed)?;
        }
        let (expected, found) = (
            follower.disk.live_tree(),
            read_tree(watched).map_err(unfollowed)?,
        );
        if let Some(path) = first_difference(&expected, &found) {
            return Err(TraceError::Unfollowed(format!(
                "model and disk differ in `{path}`"
            )));
        }
        Ok(Trace {
            initial,
            operations: follower.operations,
            status: output.status,
            complaint,
        })
    }

    /// The watched folder after the first `count` operations, as if the program had been killed then.
    pub fn after(&self, count: usize) -> Disk {
        let mut disk = self.initial.clone();
        self.operations[..count]
            .iter()
            .for_each(|operation| disk.apply(operation));
        disk
    }
}

/// First path whose content differs between `expected` and `found`.
fn first_difference<'a>(expected: &'a Tree, found: &'a Tree) -> Option<&'a String> {
    let mut paths = expected.keys().chain(found.keys());
    paths.find(|path| expected.get(*path) != found.get(*path))
}
