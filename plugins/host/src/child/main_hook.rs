//! First action of `main`: detects whether this process is a host child.
#![expect(
    unsafe_code,
    reason = "a new process owns its inherited files, and an ending process must not run exit handlers of plugins"
)]

use std::ffi::OsStr;
use std::fs::File;
use std::os::fd::{AsFd, FromRawFd, OwnedFd, RawFd};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rustix::io::fcntl_dupfd_cloexec;
use taceva_core::ErrorKind;

use super::log;
use super::sandbox::{Isolation, confine, seal};
use super::serve::serve;
use super::socket::Socket;
use super::wire::{Failure, FirstWord, Greeting, Hello};
use crate::session::Session;

/// First command-line argument of a host child. Not for users.
pub const CHILD_ARGUMENT: &str = "--taceva-host-child";

/// Returns at once unless this process was started as a host child. A host child confines itself, calls `load` with the files from the
/// host, serves the result until the host is gone, and ends.
///
/// A program that embeds the host calls this function first in `main`, while it has one thread and no open file.
///
/// # Errors
/// If `load` fails, the host receives its error kind and message.
pub fn main_if_child_with(
    load: impl FnOnce(Vec<File>) -> Result<Arc<dyn Session>, (ErrorKind, String)>,
) {
    let mut arguments = std::env::args_os().skip(1);
    if arguments.next().as_deref() != Some(OsStr::new(CHILD_ARGUMENT)) {
        CAN_BE_CHILD.store(true, Ordering::Relaxed);
        return;
    }
    let code = serve_host(|files, _| load(files));
    // SAFETY: ends the process without exit handlers, which plugins may have registered.
    unsafe { libc::_exit(code) }
}

/// Confines this process, calls `load` and serves the result to the host on standard input. Returns the exit code.
pub(super) fn serve_host(
    load: impl FnOnce(Vec<File>, &Isolation) -> Result<Arc<dyn Session>, (ErrorKind, String)>,
) -> i32 {
    orders().map_or(NOT_A_CHILD, |orders| run(orders, load))
}

/// True once `main` has checked for a host child, so that this program can be started as a host child.
static CAN_BE_CHILD: AtomicBool = AtomicBool::new(false);

/// True if this program can be started as a host child. Other programs would ignore [`CHILD_ARGUMENT`].
pub(super) fn can_be_child() -> bool {
    CAN_BE_CHILD.load(Ordering::Relaxed)
}

/// Exit code of a process that has the host-child argument but no host.
const NOT_A_CHILD: i32 = 64;

/// Moves the host's socket from standard input to a new file descriptor, and makes standard input empty. Closes every other inherited file.
fn orders() -> Option<Socket> {
    let orders = fcntl_dupfd_cloexec(std::io::stdin().as_fd(), 3).ok()?;
    let nothing = File::open("/dev/null").ok()?;
    rustix::stdio::dup2_stdin(&nothing).ok()?;
    drop(nothing);
    // SAFETY: this process has just started, so no other code owns a file except the one opened by this function.
    unsafe { close_all_but(&orders) };
    Some(Socket::from(orders))
}

/// Closes every file except the three standard files and `kept`.
///
/// # Safety
/// No other code owns an open file.
unsafe fn close_all_but(kept: &OwnedFd) {
    use std::os::fd::AsRawFd;
    let Ok(entries) = std::fs::read_dir("/proc/self/fd") else {
        return;
    };
    // Lists the files first: the folder being read is open too, and is closed when the listing ends.
    let open: Vec<RawFd> = entries
        .flatten()
        .filter_map(|entry| entry.file_name().to_str()?.parse().ok())
        .collect();
    for file in open {
        if file > 2 && file != kept.as_raw_fd() && is_open(file) {
            // SAFETY: open and without an owner, as the caller guarantees.
            drop(unsafe { OwnedFd::from_raw_fd(file) });
        }
    }
}

fn is_open(file: RawFd) -> bool {
    std::fs::symlink_metadata(format!("/proc/self/fd/{file}")).is_ok()
}

fn run(
    mut orders: Socket,
    load: impl FnOnce(Vec<File>, &Isolation) -> Result<Arc<dyn Session>, (ErrorKind, String)>,
) -> i32 {
    let first = orders.receive_with_files::<(u32, FirstWord)>();
    let Ok(((sequence, first), mut files)) = first else {
        return NOT_A_CHILD;
    };
    let hello = match first {
        FirstWord::Known(hello) => hello,
        FirstWord::OfOtherWire(wire) => {
            let failure = Failure::new(ErrorKind::Abi, "serve", &FirstWord::refusal(wire));
            // A send error means that the host is gone, and is ignored.
            let _ = orders.send(&(sequence, Greeting::Refused { failure }), &[]);
            return NOT_A_CHILD;
        }
    };
    if let Some(host) = files.pop_if(|_| hello.is_heard) {
        log::to_host(host);
    }
    let files = files.into_iter().map(File::from).collect();
    let ready = prepare(&hello, files, load);
    let (greeting, session) = match ready {
        Ok((isolation, session)) => (Greeting::Ready { isolation }, session),
        Err((kind, why)) => {
            let failure = Failure::new(kind, "serve", &why);
            (Greeting::Refused { failure }, None)
        }
    };
    if orders.send(&(sequence, greeting), &[]).is_err() {
        return 0;
    }
    serve(orders, session.as_ref());
    // Close the session normally while the host enforces its timeout.
    drop(session);
    log::end();
    0
}

/// Enforced isolation, and the loaded session; `None` if no plugin was requested.
type Prepared = (Isolation, Option<Arc<dyn Session>>);

fn prepare(
    hello: &Hello,
    files: Vec<File>,
    load: impl FnOnce(Vec<File>, &Isolation) -> Result<Arc<dyn Session>, (ErrorKind, String)>,
) -> Result<Prepared, (ErrorKind, String)> {
    let denied = |why| (ErrorKind::PermissionDenied, why);
    let isolation = confine(&hello.confinement, hello.parent).map_err(denied)?;
    let session = hello.loads.then(|| load(files, &isolation)).transpose()?;
    seal(&isolation).map_err(denied)?;
    Ok((isolation, session))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_host_of_another_wire_is_refused_before_anything_is_given_up_or_loaded() {
        let (mut host, theirs) = Socket::pair().expect("a pair");
        host.send(&(7_u32, FirstWord::OfOtherWire(3)), &[])
            .expect("sent");
        let code = run(Socket::from(theirs), |_, _| {
            Err((ErrorKind::Internal, "it was loaded".to_owned()))
        });
        assert_eq!(code, NOT_A_CHILD);
        let (sequence, greeting) = host.receive::<(u32, Greeting)>().expect("an answer");
        assert_eq!(sequence, 7);
        let Greeting::Refused { failure } = greeting else {
            panic!("it served");
        };
        assert_eq!(failure.kind, ErrorKind::Abi);
        let why = failure.cause.expect("a reason");
        assert!(why.contains("wire version 2, the program 3"), "{why}");
    }
}
