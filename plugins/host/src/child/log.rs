//! Lines that a plugin logs, on their way from its child: by a socket of their own, so that they come while a call lasts.

use std::os::fd::{AsFd, OwnedFd};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;

use super::fate::Fate;
use super::keeper::Watch;
use super::socket::{LinkError, Socket, send_now};
use super::wire::fields;
use crate::library::{Level, Log};
use crate::log::tell_lost;
use crate::shown::shown;

/// A line.
#[derive(Debug, PartialEq)]
struct Line {
    level: Level,
    target: String,
    message: String,
    /// How many before it found no room.
    lost: u64,
}

fields!(Line {
    level,
    target,
    message,
    lost
});

/// In the child: where its lines go.
static HOST: OnceLock<OwnedFd> = OnceLock::new();
static LOST: AtomicU64 = AtomicU64::new(0);

/// In the child: sends lines to `host` from now on.
pub(super) fn to_host(host: OwnedFd) {
    // A child has one host.
    let _ = HOST.set(host);
}

/// In the child: sends a line, if anybody listens; whether somebody does. One that finds no room is counted: a plugin waits for no reader.
pub(super) fn send(level: Level, target: &str, message: &str) -> bool {
    let Some(host) = HOST.get() else {
        return false;
    };
    let line = Line {
        level,
        target: target.to_owned(),
        message: message.to_owned(),
        lost: LOST.swap(0, Ordering::Relaxed),
    };
    if send_now(host.as_fd(), &line).is_err() {
        LOST.fetch_add(line.lost + 1, Ordering::Relaxed);
    }
    true
}

/// In the host: hands what comes from the child to `log` until the child is gone. A child that sends anything else is ended.
pub(super) fn listen(
    socket: Socket,
    log: Log,
    watch: Arc<Watch>,
) -> std::io::Result<JoinHandle<()>> {
    let mut socket = socket;
    std::thread::Builder::new()
        .name("taceva-log".to_owned())
        .spawn(move || {
            loop {
                match socket.receive::<Line>() {
                    Ok(line) => {
                        tell_lost(&log, line.lost);
                        log(line.level, &shown(&line.target), &shown(&line.message));
                    }
                    Err(LinkError::Closed) => return,
                    Err(LinkError::Breach(what) | LinkError::Unsendable(what)) => {
                        watch.condemn(Fate::Breach { what });
                        return;
                    }
                }
            }
        })
}
