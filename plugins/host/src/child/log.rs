//! Log lines of a plugin. A separate socket transfers the lines, so that they arrive during a call.

use std::os::fd::{AsFd, OwnedFd};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;
use std::time::Duration;

use super::exit_status::Fate;
use super::flood::Flood;
use super::socket::{LinkError, Socket, send_now};
use super::watch::Watch;
use super::wire::variants;
use crate::library::{Level, Log};
use crate::log::Limited;
use crate::text::shown;

/// Message of the log socket.
#[derive(Debug, PartialEq)]
enum LogMessage {
    Line {
        level: Level,
        target: String,
        message: String,
    },
    /// Number of lines dropped because the socket was full.
    Lost { count: u64 },
}

variants!(LogMessage, "a line of the log" {
    0 => Line { level, target, message },
    1 => Lost { count },
});

/// In the child: socket to the host.
static HOST: OnceLock<OwnedFd> = OnceLock::new();
static LOST: AtomicU64 = AtomicU64::new(0);

/// In the child: sets the socket to the host.
pub(super) fn to_host(host: OwnedFd) {
    // A child has one host.
    let _ = HOST.set(host);
}

/// In the child: sends a line. Returns false if no host listens. A line that does not fit into the socket is dropped and counted, so logging never
/// blocks.
pub(super) fn send(level: Level, target: &str, message: &str) -> bool {
    let Some(host) = HOST.get() else {
        return false;
    };
    let line = LogMessage::Line {
        level,
        target: target.to_owned(),
        message: message.to_owned(),
    };
    if tell_how_many(host).is_err() || send_now(host.as_fd(), &line).is_err() {
        LOST.fetch_add(1, Ordering::Relaxed);
    }
    true
}

/// Log target of lines that name the pending call of a plugin under examination.
pub const CALL: &str = "taceva-call";

/// In the child: reports the long-running call `doing`, which is empty if no call is pending.
pub(super) fn tell_call(doing: &'static str) {
    send(Level::Debug, CALL, doing);
}

/// Sends the number of lines dropped since the last report.
fn tell_how_many(host: &OwnedFd) -> Result<(), LinkError> {
    let count = LOST.swap(0, Ordering::Relaxed);
    let sent = match count {
        0 => Ok(()),
        _ => send_now(host.as_fd(), &LogMessage::Lost { count }),
    };
    if sent.is_err() {
        LOST.fetch_add(count, Ordering::Relaxed);
    }
    sent
}

/// In the child: sends the remaining count of dropped lines at the end. Retries while the host exists.
pub(super) fn end() {
    let Some(host) = HOST.get() else {
        return;
    };
    while let Err(LinkError::Breach(_)) = tell_how_many(host) {
        std::thread::sleep(PAUSE);
    }
}

/// Delay between attempts of an ending child to send its last count.
const PAUSE: Duration = Duration::from_millis(1);

/// Maximum number of lines that a child may log within [`Flood::WITHIN`].
const LINES_MAX: u64 = 1_000_000;

/// Kills a child that exceeds the limit of log lines.
fn flooded(flood: &mut Flood, lines: u64, watch: &Watch) {
    if flood.add(lines) {
        watch.condemn(Fate::Breach {
            what: format!(
                "it logged more than {LINES_MAX} lines within {} s",
                Flood::WITHIN.as_secs()
            ),
        });
    }
}

/// In the host: passes messages of the child to `log` until the child is gone. Kills a child that exceeds the limit or sends a malformed message.
pub(super) fn listen(
    socket: Socket,
    log: Log,
    watch: Arc<Watch>,
) -> std::io::Result<JoinHandle<()>> {
    let mut socket = socket;
    let log = Limited::new(log);
    let mut flood = Flood::new(LINES_MAX);
    std::thread::Builder::new()
        .name("taceva-log".to_owned())
        .spawn(move || {
            loop {
                match socket.receive::<LogMessage>() {
                    Ok(LogMessage::Line {
                        level,
                        target,
                        message,
                    }) => {
                        log.tell(level, &shown(&target), &shown(&message));
                        flooded(&mut flood, 1, &watch);
                    }
                    Ok(LogMessage::Lost { count }) => {
                        log.lose(count);
                        flooded(&mut flood, count, &watch);
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
