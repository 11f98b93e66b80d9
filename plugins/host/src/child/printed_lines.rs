//! Lines that a child prints. A separate thread passes the lines to the log, so that the keeper thread never waits for the log.

use std::io;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread::JoinHandle;

use crate::library::{Level, Log};
use crate::log::Limited;
use crate::text::shown;

/// Maximum size of a line, bytes. Longer lines are split.
const LINE_MAX: usize = 4096;
/// Number of lines that may wait for the log. Further lines are only counted.
const WAITING: usize = 256;
/// Log target of printed lines.
const TARGET: &str = "printed";

/// Passes printed lines of a child to the log at level `Debug`. The rate limit of the log lines that the child sends applies to them too.
pub(super) struct PrintedLines {
    begun: Vec<u8>,
    lines: Option<SyncSender<Vec<u8>>>,
    limited: Arc<Limited>,
    thread: Option<JoinHandle<()>>,
}

impl PrintedLines {
    /// Starts the thread that passes lines to `log`.
    pub(super) fn new(log: Arc<Log>) -> io::Result<PrintedLines> {
        // The message about dropped lines has this level too, because printed lines are optional output.
        let limited = Limited::new(Box::new(move |_, _, message| {
            log(Level::Debug, TARGET, message);
        }));
        let limited = Arc::new(limited);
        let (lines, waiting) = sync_channel::<Vec<u8>>(WAITING);
        let shared = Arc::clone(&limited);
        let thread = std::thread::Builder::new()
            .name("taceva-printed".to_owned())
            .spawn(move || {
                for line in waiting {
                    let line = shown(&String::from_utf8_lossy(&line));
                    shared.tell(Level::Debug, TARGET, &line);
                }
            })?;
        Ok(PrintedLines {
            begun: Vec::new(),
            lines: Some(lines),
            limited,
            thread: Some(thread),
        })
    }

    /// Adds output of the child and passes on its complete lines.
    pub(super) fn take(&mut self, bytes: &[u8]) {
        for (at, part) in bytes.split(|byte| *byte == b'\n').enumerate() {
            if at > 0 {
                self.pass_on();
            }
            let mut rest = part;
            while self.begun.len() + rest.len() >= LINE_MAX {
                let (piece, behind) = rest.split_at(LINE_MAX - self.begun.len());
                self.begun.extend_from_slice(piece);
                self.pass_on();
                rest = behind;
            }
            self.begun.extend_from_slice(rest);
        }
    }

    fn pass_on(&mut self) {
        let line = std::mem::take(&mut self.begun);
        if line.is_empty() {
            return;
        }
        let lines = self.lines.as_ref();
        if lines.is_none_or(|lines| lines.try_send(line).is_err()) {
            self.limited.lose(1);
        }
    }
}

impl Drop for PrintedLines {
    fn drop(&mut self) {
        self.pass_on();
        // Without a sender, the thread ends after the last line.
        self.lines = None;
        if let Some(thread) = self.thread.take() {
            // A panic of the log is ignored.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    #[test]
    fn lines_are_joined_and_escaped_and_all_there_at_the_end() {
        let shared = Arc::new(Mutex::new(Vec::new()));
        let heard = Arc::clone(&shared);
        let log: Log = Box::new(move |level, target: &str, message: &str| {
            let line = format!("{level:?} {target}: {message}");
            heard.lock().expect("whole").push(line);
        });
        let mut lines = PrintedLines::new(Arc::new(log)).expect("a thread");
        lines.take(b"one\n\ntw");
        lines.take(b"o\n\x1b[2Jthree\nfour");
        drop(lines);
        let expected = [
            "Debug printed: one",
            "Debug printed: two",
            "Debug printed: \\u{1b}[2Jthree",
            "Debug printed: four",
        ];
        assert_eq!(*shared.lock().expect("whole"), expected);
    }

    #[test]
    fn a_flood_of_lines_is_cut_and_counted() {
        let shared = Arc::new(Mutex::new(Vec::new()));
        let heard = Arc::clone(&shared);
        let log: Log = Box::new(move |_, _, message: &str| {
            heard.lock().expect("whole").push(message.to_owned());
        });
        let mut lines = PrintedLines::new(Arc::new(log)).expect("a thread");
        for _ in 0..10_000 {
            lines.take(b"again\n");
        }
        lines.take(&[b'x'; 3 * LINE_MAX]);
        drop(lines);
        let shared = shared.lock().expect("whole");
        let left_out = shared.iter().filter_map(|line| {
            let count = line.strip_prefix("lines left out: ")?;
            Some(count.parse::<usize>().expect("a count"))
        });
        let (notes, left_out) =
            left_out.fold((0, 0), |(notes, sum), count| (notes + 1, sum + count));
        // A slow machine takes seconds, and every second has 20 lines more.
        assert!(left_out > 9_000, "{left_out}");
        assert_eq!(shared.len() - notes + left_out, 10_003);
    }
}
