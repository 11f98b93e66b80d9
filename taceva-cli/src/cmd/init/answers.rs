//! Reads answers from standard input until its end or a signal.

use std::io;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use crate::progress::is_stopped;

/// Longest delay between a signal and the end of the answers.
const WAIT: Duration = Duration::from_millis(50);

/// Lines of standard input. A signal acts like the end of the input, so that earlier answers are kept.
#[derive(Default)]
pub(super) struct Answers {
    /// Channel from the thread that reads lines; `None` before the first question.
    lines: Option<Receiver<io::Result<String>>>,
}

impl Iterator for Answers {
    type Item = io::Result<String>;

    fn next(&mut self) -> Option<io::Result<String>> {
        let lines = self.lines.get_or_insert_with(read_on);
        loop {
            match lines.recv_timeout(WAIT) {
                Ok(line) => return Some(line),
                Err(RecvTimeoutError::Timeout) if !is_stopped() => {}
                Err(_) => return None,
            }
        }
    }
}

/// Starts a thread that reads standard input. The thread ends with the program.
fn read_on() -> Receiver<io::Result<String>> {
    let (sender, lines) = mpsc::channel();
    let reader = std::thread::Builder::new().spawn(move || {
        for line in io::stdin().lines() {
            if sender.send(line).is_err() {
                return;
            }
        }
    });
    // Without a thread the answers end at once.
    drop(reader);
    lines
}
