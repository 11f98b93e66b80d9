//! A connection to a port of reports: a thread that reads, and the newest report for whoever asks.

use std::io::{self, Read};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use super::report::{Report, ReportKind, Reports};
use crate::link::{LinkError, connect, monotonic};

/// The reports of one port.
#[derive(Debug)]
pub(super) struct Watch {
    board: Arc<Board>,
    stream: TcpStream,
    reader: Option<JoinHandle<()>>,
}

/// A report, its number since the connection was made, and when it came.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) report: Report,
    pub(super) number: u64,
    pub(super) at: Duration,
}

/// Where the thread that reads leaves what it read.
#[derive(Debug, Default)]
struct Board {
    notes: Mutex<Notes>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct Notes {
    newest: Option<Seen>,
    /// Why no report comes any more.
    ended: Option<String>,
}

impl Watch {
    /// Connects to `port` of `host`.
    pub(super) fn open(host: &str, port: u16, kind: ReportKind) -> Result<Watch, LinkError> {
        let (stream, address) = connect(host, port)?;
        let broken = |source: io::Error| LinkError::Broken { address, source };
        let reading = stream.try_clone().map_err(broken)?;
        let board = Arc::new(Board::default());
        let notes = Arc::clone(&board);
        let reader = std::thread::Builder::new()
            .name("xarm reports".to_owned())
            .spawn(move || {
                let ended = read(reading, address, kind, &notes);
                notes.note(|notes| notes.ended = Some(ended));
            })
            .map_err(broken)?;
        Ok(Watch {
            board,
            stream,
            reader: Some(reader),
        })
    }

    /// The newest report, if one has come and others still may.
    pub(super) fn newest(&self) -> Option<Seen> {
        let notes = self.board.notes();
        notes.newest.filter(|_| notes.ended.is_none())
    }

    /// The first report behind the one numbered `after`, waited for as long as `patience`.
    ///
    /// # Errors
    /// [`WatchError`]: none came, or none will.
    pub(super) fn next(&self, after: u64, patience: Duration) -> Result<Seen, WatchError> {
        let began = Instant::now();
        let mut notes = self.board.notes();
        loop {
            if let Some(why) = &notes.ended {
                return Err(WatchError::Ended(why.clone()));
            }
            if let Some(seen) = notes.newest.filter(|seen| seen.number > after) {
                return Ok(seen);
            }
            let left = patience.saturating_sub(began.elapsed());
            if left.is_zero() {
                return Err(WatchError::Silent);
            }
            let waited = self.board.changed.wait_timeout(notes, left);
            notes = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

/// Why there is no newer report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum WatchError {
    /// None came in time.
    Silent,
    /// The connection is of no use any more.
    Ended(String),
}

impl Board {
    fn notes(&self) -> std::sync::MutexGuard<'_, Notes> {
        self.notes.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn note(&self, change: impl FnOnce(&mut Notes)) {
        change(&mut self.notes());
        self.changed.notify_all();
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        // The thread that reads ends with the stream.
        let _ = self.stream.shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Notes every report until none can come any more, and says why.
fn read(mut stream: TcpStream, address: SocketAddr, kind: ReportKind, board: &Board) -> String {
    let mut reports = Reports::new(kind);
    let mut number = 0;
    let mut bytes = [0; 4096];
    loop {
        match stream.read(&mut bytes) {
            Ok(0) => return LinkError::Closed { address }.to_string(),
            Ok(count) => reports.push(&bytes[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(source) => return LinkError::Broken { address, source }.to_string(),
        }
        let at = monotonic();
        loop {
            match reports.next() {
                Ok(None) => break,
                Ok(Some(report)) => {
                    number += 1;
                    let seen = Seen { report, number, at };
                    board.note(|notes| notes.newest = Some(seen));
                }
                Err(error) => {
                    let _ = stream.shutdown(Shutdown::Both);
                    return format!("{address} sends what is no report of an xArm: {error}");
                }
            }
        }
    }
}
