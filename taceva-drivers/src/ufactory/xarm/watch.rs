//! Connection to a report port: a reader thread posts the newest report.

use std::io::{self, Read};
use std::net::{Shutdown, SocketAddr, TcpStream};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use taceva_core::ErrorKind;

use super::report::{ArmReport, ReportKind, Reports};
use crate::link::mailbox::{Ending, NoNews};
use crate::link::{LinkError, Mailbox, Seen, connect, monotonic};

/// Connection that receives the reports of one port.
#[derive(Debug)]
pub(super) struct Watch {
    reports: Arc<Mailbox<ArmReport>>,
    stream: TcpStream,
    reader: Option<JoinHandle<()>>,
}

impl Watch {
    /// Connects to `port` of `host`.
    pub(super) fn open(host: &str, port: u16, kind: ReportKind) -> Result<Watch, LinkError> {
        let (stream, address) = connect(host, port)?;
        let broken = |source: io::Error| LinkError::Broken { address, source };
        let reading = stream.try_clone().map_err(broken)?;
        let reports = Arc::new(Mailbox::default());
        let posting = Arc::clone(&reports);
        let reader = std::thread::Builder::new()
            .name("xarm reports".to_owned())
            .spawn(move || {
                let ending = read(reading, address, kind, &posting);
                posting.end(ending);
            })
            .map_err(broken)?;
        Ok(Watch {
            reports,
            stream,
            reader: Some(reader),
        })
    }

    /// Mailbox that contains the newest report.
    pub(super) fn mailbox(&self) -> Arc<Mailbox<ArmReport>> {
        Arc::clone(&self.reports)
    }

    /// Newest report; `None` before the first report and after the end of the connection.
    pub(super) fn newest(&self) -> Option<Seen<ArmReport>> {
        self.reports.newest()
    }

    /// Waits up to `patience` for a report newer than number `after`.
    ///
    /// # Errors
    /// [`NoNews`] after a timeout, an interrupt, or the end of the connection.
    pub(super) fn next(&self, after: u64, patience: Duration) -> Result<Seen<ArmReport>, NoNews> {
        self.reports.next(after, patience)
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        // The shutdown ends the reader thread.
        let _ = self.stream.shutdown(Shutdown::Both);
        if let Some(reader) = self.reader.take() {
            let _ = reader.join();
        }
    }
}

/// Posts reports to `posting` until the connection ends. Returns the reason for the end.
fn read(
    mut stream: TcpStream,
    address: SocketAddr,
    kind: ReportKind,
    posting: &Mailbox<ArmReport>,
) -> Ending {
    let mut reports = Reports::new(kind);
    let mut bytes = [0; 4096];
    loop {
        match stream.read(&mut bytes) {
            Ok(0) => return LinkError::Closed { address }.into(),
            Ok(count) => reports.push(&bytes[..count]),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(source) => return LinkError::Broken { address, source }.into(),
        }
        let at = monotonic();
        let (mut count, mut newest) = (0, None);
        loop {
            match reports.next() {
                Ok(None) => break,
                Ok(Some(report)) => {
                    count += 1;
                    newest = Some(report);
                }
                Err(error) => {
                    let _ = stream.shutdown(Shutdown::Both);
                    return Ending {
                        kind: ErrorKind::Protocol,
                        why: format!("{address} sent an invalid report for an xArm: {error}"),
                    };
                }
            }
        }
        if let Some(report) = newest {
            posting.post_last(count, report, at);
        }
    }
}
