//! Decoder program, whose output arrives in pieces of limited size. The program is killed after a timeout without output, or when no longer needed.

use std::io::{self, BufRead, BufReader, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

/// Time without output after which a decoder program is killed.
pub(crate) const SILENCE: Duration = Duration::from_secs(60);
/// Maximum length of a line of output, bytes. Longer lines are split.
const LINE_BYTES: u64 = 1 << 16;
/// Maximum number of queued pieces of output, which limits the memory.
const WAITING: usize = 4;

/// Piece of the output of a decoder program.
#[derive(Debug)]
pub(crate) enum Piece {
    /// Line of standard error, without its end.
    Line(String),
    /// Block of standard output.
    Block(Vec<u8>),
}

/// Callback that reads the next block of standard output. An empty block means the end of the output.
pub(crate) type Take = Box<dyn FnMut(&mut dyn Read) -> io::Result<Vec<u8>> + Send>;

/// Reads blocks of `size` bytes. The last block may be shorter.
pub(crate) fn blocks_of(size: usize) -> Take {
    Box::new(move |output| {
        let mut block = Vec::with_capacity(size);
        output.take(size as u64).read_to_end(&mut block)?;
        Ok(block)
    })
}

/// Program that runs until it exits or this value is dropped.
#[derive(Debug)]
pub(crate) struct Running {
    child: Child,
    pieces: Receiver<Piece>,
}

/// Reason why no further piece arrives.
#[derive(Debug)]
pub(crate) enum Ended {
    /// The program exited with this status.
    By(ExitStatus),
    /// The program wrote no output for [`SILENCE`] and was killed.
    Silent,
    /// Waiting for the exit of the program failed.
    Unknown(io::Error),
}

impl Running {
    /// Starts `command`. `take` reads the standard output; without `take` the output is discarded.
    ///
    /// # Errors
    /// Error of the operating system if the program cannot be started.
    pub(crate) fn start(mut command: Command, take: Option<Take>) -> io::Result<Running> {
        command.stderr(Stdio::piped());
        command.stdout(match take {
            Some(_) => Stdio::piped(),
            None => Stdio::null(),
        });
        let mut child = command.spawn()?;
        let (send, pieces) = sync_channel(WAITING);
        let lines = child.stderr.take().map(BufReader::new);
        let blocks = child.stdout.take().zip(take);
        let running = Running { child, pieces };
        if let Some(lines) = lines {
            let send = send.clone();
            thread::Builder::new().spawn(move || send_lines(lines, &send))?;
        }
        if let Some((blocks, take)) = blocks {
            thread::Builder::new().spawn(move || send_blocks(blocks, take, &send))?;
        }
        Ok(running)
    }

    /// Child process.
    pub(crate) fn child(&mut self) -> &mut Child {
        &mut self.child
    }

    /// Next piece of output, or the reason why no further piece arrives.
    pub(crate) fn next(&mut self) -> Result<Piece, Ended> {
        match self.pieces.recv_timeout(SILENCE) {
            Ok(piece) => Ok(piece),
            Err(RecvTimeoutError::Timeout) => {
                self.kill();
                Err(Ended::Silent)
            }
            // Both pipes were closed. This happens at the exit.
            Err(RecvTimeoutError::Disconnected) => Err(match self.child.wait() {
                Ok(status) => Ended::By(status),
                Err(error) => Ended::Unknown(error),
            }),
        }
    }

    fn kill(&mut self) {
        // The program may have ended already.
        drop(self.child.kill());
        drop(self.child.wait());
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.kill();
    }
}

impl std::fmt::Display for Ended {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Ended::By(status) => write!(f, "ended with {status}"),
            Ended::Silent => write!(
                f,
                "sent no output for {} s and was killed",
                SILENCE.as_secs()
            ),
            Ended::Unknown(error) => write!(f, "cannot be waited for: {error}"),
        }
    }
}

fn send_lines(mut lines: impl BufRead, send: &SyncSender<Piece>) {
    loop {
        let mut line = Vec::new();
        match lines.by_ref().take(LINE_BYTES).read_until(b'\n', &mut line) {
            Ok(0) | Err(_) => return,
            Ok(_) => {}
        }
        let line = String::from_utf8_lossy(&line).trim_end().to_owned();
        if send.send(Piece::Line(line)).is_err() {
            return;
        }
    }
}

fn send_blocks(mut blocks: impl Read, mut take: Take, send: &SyncSender<Piece>) {
    while let Ok(block) = take(&mut blocks) {
        if block.is_empty() || send.send(Piece::Block(block)).is_err() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn blocks_and_lines_come_apart_and_the_end_is_known() {
        let mut command = Command::new("sh");
        command.args(["-c", "printf 1234567; echo one >&2; echo two >&2; exit 3"]);
        let mut running = Running::start(command, Some(blocks_of(4))).expect("starts");
        let (mut lines, mut blocks) = (Vec::new(), Vec::new());
        let ended = loop {
            match running.next() {
                Ok(Piece::Line(line)) => lines.push(line),
                Ok(Piece::Block(block)) => blocks.push(block),
                Err(ended) => break ended,
            }
        };
        assert_eq!(lines, ["one", "two"]);
        assert_eq!(blocks, [b"1234".to_vec(), b"567".to_vec()]);
        match ended {
            Ended::By(status) => assert_eq!(status.code(), Some(3)),
            other => panic!("{other}"),
        }
    }
}
