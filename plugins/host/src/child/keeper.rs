//! The thread that starts a child, watches it, ends it when it is late, and says how it ended.
//!
//! The kernel ends a child with the *thread* that started it, so this one starts it and outlives it. It is also the one watchdog: calls note
//! until when they wait and block; a child that is ended closes its sockets, which wakes them.

use std::collections::{BTreeMap, VecDeque};
use std::fs::File;
use std::io::{self, Read};
use std::os::fd::{AsFd, OwnedFd};
use std::process::{Child as Process, Command};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustix::event::{EventfdFlags, PollFd, PollFlags, Timespec, eventfd, poll};
use rustix::process::{Pid, PidfdFlags, Signal, pidfd_open, pidfd_send_signal};

use super::fate::Fate;
use taceva_core::is_obeyed;

/// How much of the last that a child printed is kept.
const PRINTED_MAX: usize = 4096;

/// How much a pipe holds.
const PIPE_MAX: usize = 64 * 1024;

/// What the keeper shares with those who call.
#[derive(Debug)]
pub(crate) struct Watch {
    state: Mutex<State>,
    ended: Condvar,
    wake: OwnedFd,
}

#[derive(Debug, Default)]
struct State {
    calls: BTreeMap<u64, Expiry>,
    next_call: u64,
    /// When the keeper looks again by itself; `None`: when something happens.
    looks_at: Option<Instant>,
    /// Why it is to be ended, if it is.
    sentence: Option<Fate>,
    /// Whether it was asked to end.
    is_ending: bool,
    fate: Option<Fate>,
    printed: VecDeque<u8>,
}

#[derive(Debug)]
struct Expiry {
    at: Instant,
    after: Duration,
    doing: String,
}

/// A call that is being waited for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CallId(u64);

impl Watch {
    /// Notes a call that must be answered within `after`.
    pub(crate) fn begin(&self, doing: &str, after: Duration) -> CallId {
        let mut state = self.state();
        let id = state.next_call;
        state.next_call += 1;
        // A deadline beyond the clock's end is as good as a century.
        let now = Instant::now();
        let at = now
            .checked_add(after)
            .unwrap_or(now + Duration::from_secs(3_153_600_000));
        let doing = doing.to_owned();
        state.calls.insert(id, Expiry { at, after, doing });
        self.look_at(&mut state, at);
        CallId(id)
    }

    /// Notes that a call was answered.
    pub(crate) fn end(&self, call: CallId) {
        self.state().calls.remove(&call.0);
    }

    /// Shortens what is left of a call, if it is still being waited for.
    pub(crate) fn hasten(&self, call: CallId, after: Duration) {
        let mut state = self.state();
        let at = Instant::now() + after;
        if let Some(expiry) = state.calls.get_mut(&call.0).filter(|call| call.at > at) {
            expiry.at = at;
            expiry.after = after;
            expiry.doing = format!("end its call to {} after an interrupt", expiry.doing);
            self.look_at(&mut state, at);
        }
    }

    /// Ends the child, for this reason unless there is one already.
    pub(crate) fn condemn(&self, reason: Fate) {
        let mut state = self.state();
        state.sentence.get_or_insert(reason);
        self.look_at(&mut state, Instant::now());
    }

    /// Notes that the child is asked to end, so that it may.
    pub(crate) fn expect_end(&self) {
        self.state().is_ending = true;
    }

    /// How the child ended; `None` while it lives.
    pub(crate) fn fate(&self) -> Option<Fate> {
        self.state().fate.clone()
    }

    /// How the child ended; waits for that as long as it takes a process that closed its sockets to be gone.
    pub(crate) fn final_fate(&self) -> Fate {
        let closing = Duration::from_millis(250);
        let (state, _) = self
            .ended
            .wait_timeout_while(self.state(), closing, |state| state.fate.is_none())
            .unwrap_or_else(PoisonError::into_inner);
        if let Some(fate) = &state.fate {
            return fate.clone();
        }
        drop(state);
        // It lives, and hangs up.
        self.condemn(Fate::Breach {
            what: "it closed the connection to its host".to_owned(),
        });
        let state = self
            .ended
            .wait_while(self.state(), |state| state.fate.is_none())
            .unwrap_or_else(PoisonError::into_inner);
        state.fate.clone().unwrap_or(Fate::Closed)
    }

    /// The last that it printed, control characters written out.
    pub(crate) fn printed(&self) -> String {
        let bytes: Vec<u8> = self.state().printed.iter().copied().collect();
        plain(&String::from_utf8_lossy(&bytes))
    }

    fn look_at(&self, state: &mut State, at: Instant) {
        if state.looks_at.is_none_or(|looks_at| at < looks_at) {
            state.looks_at = Some(at);
            // A counter that is full wakes as well.
            let _ = rustix::io::write(&self.wake, &1_u64.to_ne_bytes());
        }
    }

    /// The state, whole whatever happened to another thread: every change of it is finished before it can be interrupted.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is to be done now: a reason to end the child, or how long to wait.
    fn look(&self) -> Result<Option<Duration>, Fate> {
        let mut state = self.state();
        let now = Instant::now();
        if state.sentence.is_none() {
            let late = state.calls.values().find(|call| call.at <= now);
            let late = late.map(|call| Fate::Late {
                doing: call.doing.clone(),
                after: call.after,
            });
            state.sentence = late;
        }
        if let Some(reason) = state.sentence.clone() {
            return Err(reason);
        }
        // With nothing to wait for it looks again when it would have, so that a stream of short calls does not wake it for each.
        let next = state.calls.values().map(|call| call.at).min();
        state.looks_at = next.or(state.looks_at.filter(|at| *at > now));
        Ok(state.looks_at.map(|at| at.saturating_duration_since(now)))
    }

    fn printed_more(&self, bytes: &[u8]) {
        let mut state = self.state();
        state.printed.extend(bytes);
        let surplus = state.printed.len().saturating_sub(PRINTED_MAX);
        state.printed.drain(..surplus);
    }

    fn ended(&self, fate: Fate) {
        let mut state = self.state();
        let fate = state.sentence.take().unwrap_or(fate);
        let is_asked_for = state.is_ending && fate == Fate::Exited { code: 0 };
        state.fate = Some(if is_asked_for { Fate::Closed } else { fate });
        drop(state);
        self.ended.notify_all();
    }
}

/// `text` with control characters written out, so that a terminal shows it and does not obey it.
pub(crate) fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' => plain.push('\n'),
            _ if is_obeyed(character) => {
                plain.extend(character.escape_unicode());
            }
            _ => plain.push(character),
        }
    }
    plain
}

/// A running child: its number, what watches it, and the thread that does.
#[derive(Debug)]
pub(crate) struct Kept {
    pub(crate) process: u32,
    pub(crate) watch: Arc<Watch>,
    pub(crate) keeper: JoinHandle<()>,
}

/// Starts a process and a thread that keeps it. What it prints comes from `output`, whose other end `command` holds; `ended` is called
/// with how it ended.
pub(crate) fn keep(
    command: Command,
    output: OwnedFd,
    ended: impl FnOnce(&Fate) + Send + 'static,
) -> io::Result<Kept> {
    let wake = eventfd(0, EventfdFlags::CLOEXEC | EventfdFlags::NONBLOCK)?;
    let watch = Arc::new(Watch {
        state: Mutex::default(),
        ended: Condvar::new(),
        wake,
    });
    let (started, start) = channel();
    let shared = Arc::clone(&watch);
    let keeper = std::thread::Builder::new()
        .name("taceva-keeper".to_owned())
        .spawn(move || {
            let Some((process, handle)) = start_process(command, &started) else {
                return;
            };
            // Whoever started it must learn its number before it can end.
            drop(started);
            let fate = Fate::of(watch_over(&shared, process, &handle, output));
            shared.ended(fate);
            if let Some(fate) = shared.fate() {
                ended(&fate);
            }
        })?;
    match start.recv() {
        Ok(Ok(process)) => Ok(Kept {
            process,
            watch,
            keeper,
        }),
        Ok(Err(error)) => Err(error),
        Err(_) => Err(io::Error::other("the thread that keeps a child is gone")),
    }
}

fn start_process(
    mut command: Command,
    started: &Sender<io::Result<u32>>,
) -> Option<(Process, OwnedFd)> {
    let process = command.spawn().and_then(|process| {
        let number = i32::try_from(process.id()).ok().and_then(Pid::from_raw);
        let number = number.ok_or_else(|| io::Error::other("a process without a number"))?;
        Ok((process, pidfd_open(number, PidfdFlags::empty())?))
    });
    // The ends that the child holds now must not stay open here, or nobody would see it close them.
    drop(command);
    match process {
        Ok((process, handle)) => {
            let _ = started.send(Ok(process.id()));
            Some((process, handle))
        }
        Err(error) => {
            let _ = started.send(Err(error));
            None
        }
    }
}

fn watch_over(
    watch: &Watch,
    mut process: Process,
    handle: &OwnedFd,
    output: OwnedFd,
) -> std::process::ExitStatus {
    let mut output = Some(File::from(output));
    let mut left_to_read = PIPE_MAX / PRINTED_MAX;
    loop {
        let wait = watch.look().unwrap_or_else(|_| {
            // By the handle, which is never another process's. It may have ended by itself already.
            let _ = pidfd_send_signal(handle, Signal::KILL);
            None
        });
        let timeout = wait.and_then(|wait| Timespec::try_from(wait).ok());
        let mut polled = vec![
            PollFd::new(handle, PollFlags::IN),
            PollFd::new(&watch.wake, PollFlags::IN),
        ];
        if let Some(output) = &output {
            polled.push(PollFd::from_borrowed_fd(output.as_fd(), PollFlags::IN));
        }
        // An interrupted poll says nothing.
        let _ = poll(&mut polled, timeout.as_ref());
        let has = |at: usize| polled.get(at).is_some_and(|fd| !fd.revents().is_empty());
        let (has_ended, was_woken, has_printed) = (has(0), has(1), has(2));
        if was_woken {
            let _ = rustix::io::read(&watch.wake, &mut [0_u8; 8]);
        }
        if has_printed {
            let mut bytes = [0; PRINTED_MAX];
            match output.as_mut().map(|output| output.read(&mut bytes)) {
                Some(Ok(count)) if count > 0 => watch.printed_more(&bytes[..count]),
                _ => output = None,
            }
        }
        if has_ended && has_printed && left_to_read > 0 {
            left_to_read -= 1;
        } else if has_ended {
            // The process is a child of this one that nobody else waits for.
            return process.wait().unwrap_or_default();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        assert_eq!(
            plain("a\u{1b}[2Jb\u{202e}c\nd\0"),
            "a\\u{1b}[2Jb\\u{202e}c\nd\\u{0}"
        );
    }
}
