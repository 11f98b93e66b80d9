//! Keeper thread: starts a child, watches it, kills it when a call times out, and reports how it ended.
//!
//! The kernel kills a child when the *thread* that started it ends, so the keeper starts the child and outlives it. The keeper is also the only watchdog.
//! Callers record their timeout and block. The sockets of a killed child close, which wakes the callers.

use std::fs::File;
use std::io::{self, Read};
use std::os::fd::{AsFd, OwnedFd};
use std::process::{Child as Process, Command};
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::process::{Pid, PidfdFlags, Signal, pidfd_open, pidfd_send_signal};

use super::exit_status::Fate;
use super::flood::Flood;
use super::printed_lines::PrintedLines;
use super::usage::{Usage, processor_time};
use super::watch::{PRINTED_MAX, Watch};

/// Limit of output within [`Flood::WITHIN`], bytes.
const PRINTED_IN_ALL: u64 = 64 << 20;
/// Capacity of a pipe, bytes.
const PIPE_MAX: usize = 64 * 1024;

/// Running child: process number, shared state of its end, and keeper thread.
#[derive(Debug)]
pub(crate) struct Kept {
    pub(crate) process: u32,
    pub(crate) watch: Arc<Watch>,
    pub(crate) keeper: JoinHandle<()>,
}

/// Starts a process and its keeper thread. `output` is the read end of the pipe that `command` prints to; `lines` receives the printed lines. The keeper calls
/// `ended` with the reason for the end of the child.
pub(super) fn keep(
    command: Command,
    output: OwnedFd,
    lines: Option<PrintedLines>,
    ended: impl FnOnce(&Fate, Usage) + Send + 'static,
) -> io::Result<Kept> {
    let watch = Arc::new(Watch::new()?);
    let (started, start) = channel();
    let shared = Arc::clone(&watch);
    let keeper = std::thread::Builder::new()
        .name("taceva-keeper".to_owned())
        .spawn(move || {
            let Some((process, handle)) = start_process(command, &started) else {
                return;
            };
            // The caller must receive the process number before the child can end.
            drop(started);
            let begun = Instant::now();
            let mut lines = lines;
            let (status, processor) = watch_over(&shared, process, &handle, output, lines.as_mut());
            shared.ended(Fate::of(status));
            if let Some(fate) = shared.fate() {
                let usage = Usage {
                    whole: begun.elapsed(),
                    processor,
                    calls: shared.called(),
                };
                ended(&fate, usage);
            }
            // Waits until the last line is logged, after all waiting callers were woken.
            drop(lines);
        })?;
    match start.recv() {
        Ok(Ok(process)) => Ok(Kept {
            process,
            watch,
            keeper,
        }),
        Ok(Err(error)) => Err(error),
        Err(_) => Err(io::Error::other(
            "the thread that supervises a child has ended",
        )),
    }
}

fn start_process(
    mut command: Command,
    started: &Sender<io::Result<u32>>,
) -> Option<(Process, OwnedFd)> {
    let process = command.spawn().and_then(|process| {
        let number = i32::try_from(process.id()).ok().and_then(Pid::from_raw);
        let number = number.ok_or_else(|| io::Error::other("the started process has no id"))?;
        Ok((process, pidfd_open(number, PidfdFlags::empty())?))
    });
    // Closes the child's pipe ends here. Otherwise the host would not notice that the child closes them.
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
    mut lines: Option<&mut PrintedLines>,
) -> (std::process::ExitStatus, Duration) {
    let mut flood = Flood::new(PRINTED_IN_ALL);
    let mut output = Some(File::from(output));
    let mut left_to_read = PIPE_MAX / PRINTED_MAX;
    loop {
        let wait = watch.look().unwrap_or_else(|_| {
            // The handle never refers to another process. The child may have ended already.
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
        // An interrupted poll is ignored.
        let _ = poll(&mut polled, timeout.as_ref());
        let has = |at: usize| polled.get(at).is_some_and(|fd| !fd.revents().is_empty());
        let (has_ended, was_woken, has_printed) = (has(0), has(1), has(2));
        if was_woken {
            let _ = rustix::io::read(&watch.wake, &mut [0_u8; 8]);
        }
        if has_printed {
            let mut bytes = [0; PRINTED_MAX];
            match output.as_mut().map(|output| output.read(&mut bytes)) {
                Some(Ok(count)) if count > 0 => {
                    watch.printed_more(&bytes[..count]);
                    if let Some(lines) = &mut lines {
                        lines.take(&bytes[..count]);
                    }
                    if flood.add(count as u64) {
                        watch.condemn(Fate::Breach {
                            what: format!(
                                "it printed more than {} MiB within {} s",
                                PRINTED_IN_ALL >> 20,
                                Flood::WITHIN.as_secs()
                            ),
                        });
                    }
                }
                _ => output = None,
            }
        }
        if has_ended && has_printed && left_to_read > 0 {
            left_to_read -= 1;
        } else if has_ended {
            // The process number stays valid until the wait, so its processor time is read first.
            let processor = processor_time(process.id());
            // The process is a child of this one, and no other code waits for it.
            return (process.wait().unwrap_or_default(), processor);
        }
    }
}
